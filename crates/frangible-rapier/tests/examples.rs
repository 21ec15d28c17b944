//! The examples run as a user would run them, and say what they are about.

use std::process::Command;

/// Output of an example. Cargo builds examples beside the tests.
fn output(name: &str) -> String {
    let test = std::env::current_exe().unwrap();
    let folder = test.ancestors().nth(2).unwrap().join("examples");
    let program = folder.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    let output = Command::new(&program).output();
    let output = output.unwrap_or_else(|error| panic!("{}: {error}", program.display()));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {error}");
    let text = String::from_utf8(output.stdout).unwrap();
    println!("{text}");
    text
}

/// All numbers in a text.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_digit() || ".+-".contains(c)));
    words.filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn a_glass_falls_and_breaks() {
    let text = output("glass");
    assert!(numbers(&text)[0] > 3.0);
}

#[test]
fn a_stone_goes_on_through_the_window_of_a_games_own_world() {
    let text = output("window");
    let found = numbers(&text);
    let [pieces, speed, sounds] = found[..] else {
        panic!("{text}")
    };
    // The stone has 0.29 kg and the pane 2.4 kg: a stone that stuck to a pane that holds nowhere would go on at 1.5 m/s with it. One that
    // is faster has gone through. How much faster is up to one star's cracks (3.3 m/s with this seed), and docs/engines.md has means.
    assert!(pieces > 5.0 && speed > 2.0 && speed < 14.5 && sounds > 2.0);
}

#[test]
fn a_heavier_stone_needs_less_speed() {
    let text = output("ask");
    let speeds: Vec<Vec<f64>> = text.lines().skip(1).map(numbers).collect();
    assert_eq!(speeds.len(), 4);
    for column in [1, 2] {
        let first_and_last = [&speeds[0], &speeds[3]].map(|row| row[column]);
        assert!(first_and_last[1] < 0.5 * first_and_last[0]);
    }
}

#[test]
fn a_tile_breaks_where_it_is_scored() {
    let text = output("painted");
    let line = text
        .lines()
        .find(|line| line.starts_with("scored"))
        .unwrap();
    let at = numbers(line)[0];
    assert!((at - 0.05).abs() < 0.015, "{at}");
}

#[test]
fn a_break_is_made_again_from_bytes() {
    assert!(output("replay").contains("bit for bit"));
}

#[test]
fn a_hundred_pots_break() {
    let text = output("pots");
    assert!(numbers(&text)[0] >= 90.0);
}

#[test]
fn the_nearest_pane_of_an_explosion_breaks_and_the_farthest_holds() {
    let text = output("explosion");
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].contains("pieces") && lines[2].contains("whole"));
}
