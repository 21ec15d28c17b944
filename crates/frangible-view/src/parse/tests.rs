use super::*;

#[test]
fn every_command_reads_what_it_writes() {
    let sample = |word: &str| match word {
        "NAME" | "MATERIAL" | "NAME|all" => "steel".to_string(),
        "FILE" | "FILE.png" => "a folder/x.png".into(),
        "N" | "NUMBER" => "7".into(),
        "first|METHOD,METHOD" => "ours,voronoi".into(),
        _ if word.ends_with("X,Y,Z") => "0.1,-2,0.0003".into(),
        _ if word.contains('|') => word.split('|').next().unwrap_or_default().into(),
        _ => "0.25".into(),
    };
    for (word, form) in FORMS {
        let after: Vec<String> = form.split_whitespace().map(sample).collect();
        let line = format!("{word} {}", after.join(" "));
        let command = Command::parse(&line).unwrap();
        assert_eq!(command.to_string(), line.trim());
        assert_eq!(Command::parse(&command.to_string()).unwrap(), command);
    }
}

#[test]
fn a_film_has_its_options_behind_its_file() {
    for (line, written) in [
        ("save gif a b.gif", "save gif a b.gif"),
        (
            "save gif a.gif 2s 15fps 320x200",
            "save gif a.gif 2s 15fps 320x200",
        ),
        (
            "save still x.png 8spp 320x200",
            "save still x.png 320x200 8spp",
        ),
        ("save mp4 3s.mp4 20fps 3s", "save mp4 3s.mp4"),
    ] {
        assert_eq!(Command::parse(line).unwrap().to_string(), written);
    }
    let error = Command::parse("save gif a.gif 320x200 1").unwrap_err();
    assert!(error.to_string().contains("`1`"), "{error}");
    let error = Command::parse("save gif 3s").unwrap_err().to_string();
    assert!(error.contains("`save gif FILE`"), "{error}");
}

#[test]
fn mistakes_say_what_would_do() {
    for (line, hint) in [
        ("scen glass", "did you mean `scene`?"),
        ("step many", "`many` is not a whole number"),
        ("throw 0,0 1,2,3", "write x,y,z"),
        ("look inside", "world, stress, cracks"),
        ("ball 1 2", "write it as `ball KG"),
        ("slow-motion NaN", "is not a number"),
        ("reset now", "write it as `reset "),
        ("", "there is no command"),
    ] {
        let error = Command::parse(line).unwrap_err().to_string();
        assert!(error.contains(hint), "{line}: {error}");
    }
}
