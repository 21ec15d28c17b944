//! Bodies divided by labels.

use super::common::{Case, plate};
use frangible::Breakable;
use frangible_lab::compare::{CompareError, Division};

#[test]
fn labels_that_cannot_be_used_are_refused() {
    let body = Case::of_plate().body;
    let nodes = body.asset().fracture().positions.len();
    let refused = |labels: Vec<u32>, at: f64| {
        let error = Division::new(&body, labels, |_, _| at).expect_err("refused");
        assert!(matches!(error, CompareError::Labels(_)));
        error.to_string()
    };
    assert!(refused(vec![0; nodes - 1], 0.5).contains(&format!("{nodes} nodes")));
    let mut half = vec![0; nodes];
    half[..nodes / 2].fill(1);
    assert!(refused(half, f64::NAN).contains("is not a number"));
}

#[test]
fn borders_add_up_to_the_faces_between_the_pieces() {
    let body = Breakable::uniform(plate()).expect("a sound asset").body(1);
    let mesh = body.asset().fracture();
    // Quarters, by the signs of x and y.
    let quarter = |v: usize| {
        let p = mesh.positions[v];
        u32::from(p.x > 0.013) + 2 * u32::from(p.y > -0.021)
    };
    let labels: Vec<u32> = (0..mesh.positions.len()).map(quarter).collect();
    let division = || Division::new(&body, labels.clone(), |_, _| 0.5).expect("a division");
    let (pieces, borders) = division().pieces(0.0);
    assert_eq!(pieces.len(), 4);
    let area: f64 = borders.iter().map(|b| b.area).sum();
    let alone: f64 = division().borders().iter().map(|b| b.area).sum();
    assert!((area / alone - 1.0).abs() < 1e-12);
    // Two cuts of 0.2 m × 6 mm, straight but for the mesh's zigzag.
    assert!((1.0..1.5).contains(&(area / (2.0 * 0.2 * 0.006))), "{area}");
    // Joined in pairs, the border between the pairs stays as it was.
    let (halves, seam) = division().relabelled(|label| label % 2).pieces(0.0);
    assert_eq!(halves.len(), 2);
    let between: f64 = (division().borders().iter())
        .filter(|b| b.between[0] % 2 != b.between[1] % 2)
        .map(|b| b.area)
        .sum();
    let seam: f64 = seam.iter().map(|b| b.area).sum();
    assert!((seam / between - 1.0).abs() < 0.05, "{seam} and {between}");
    let volume: f64 = halves.iter().map(|f| f.mass.volume).sum();
    assert!((volume / mesh.total_volume() - 1.0).abs() < 1e-12);
}

#[test]
fn what_is_too_small_stays_with_a_neighbour() {
    let body = Case::of_plate().body;
    let nodes = body.asset().fracture().positions.len();
    let mut labels = vec![0; nodes];
    labels[7] = 1;
    let division =
        |labels: &[u32]| Division::new(&body, labels.to_vec(), |_, _| 0.3).expect("a division");
    assert_eq!(division(&labels).pieces(0.0).0.len(), 2);
    let (whole, borders) = division(&labels).pieces(0.01);
    assert_eq!((whole.len(), borders.len()), (1, 0));
}
