//! Choice of the fragments to analyse.

use std::sync::Arc;

use frangible::internals::Portion;
use frangible::{Body, Fracture};

/// Fewest uncut tetrahedra and least mass, kg, of a piece that breaks again: those of the world's default.
pub(crate) const LEAST_TETS: usize = 60;
pub(crate) const LEAST_MASS: f64 = 2e-3;

/// A body that broke, and its pieces.
#[derive(Clone, Debug)]
pub struct Broken {
    /// Name in the tables.
    pub name: String,
    /// The body as it was.
    pub body: Body,
    /// Fracture of the body.
    pub fracture: Fracture,
}

impl Broken {
    /// A body and its fracture.
    #[must_use]
    pub fn new(name: impl Into<String>, body: Body, fracture: Fracture) -> Self {
        Self {
            name: name.into(),
            body,
            fracture,
        }
    }

    /// The fragments that may break again, with their numbers.
    pub(crate) fn portions(&self) -> impl Iterator<Item = (usize, Arc<Portion>)> {
        let heavy = |_, f: &frangible::Fragment| f.mass.mass >= LEAST_MASS;
        let portions = self.fracture.portions(&self.body, heavy);
        let numbered = portions.into_iter().enumerate();
        numbered
            .filter_map(|(k, portion)| portion.map(|p| (k, p)))
            .filter(|(_, portion)| portion.tets().len() >= LEAST_TETS)
    }
}

/// A fragment to look at.
#[derive(Clone, Debug)]
pub(crate) struct Chosen {
    /// Number of the body.
    pub(crate) broken: usize,
    /// Number of the fragment among its.
    pub(crate) fragment: usize,
    pub(crate) portion: Arc<Portion>,
}

/// Chooses up to `count` fragments, of each name as many as it has or its share, spread evenly over their sizes; by rising size.
pub(crate) fn choose(broken: &[Broken], count: usize) -> Vec<Chosen> {
    let mut names: Vec<(&str, Vec<Chosen>)> = Vec::new();
    for (number, body) in broken.iter().enumerate() {
        let all = body.portions().map(|(fragment, portion)| Chosen {
            broken: number,
            fragment,
            portion,
        });
        match names.iter_mut().find(|n| n.0 == body.name) {
            Some(known) => known.1.extend(all),
            None => names.push((&body.name, all.collect())),
        }
    }
    let quota = quotas(&names.iter().map(|n| n.1.len()).collect::<Vec<_>>(), count);
    let mut chosen = Vec::new();
    for ((_, mut all), quota) in names.into_iter().zip(quota) {
        all.sort_by_key(|c| c.portion.tets().len());
        // Of n sorted pieces the k-th of q: the middle of the k-th of q equal stretches.
        let n = all.len();
        chosen.extend((0..quota).map(|k| all[(2 * k + 1) * n / (2 * quota)].clone()));
    }
    chosen.sort_by_key(|c| (c.portion.tets().len(), c.broken, c.fragment));
    chosen
}

/// Equal shares of `count`; a share that one cannot fill goes to the others.
fn quotas(available: &[usize], count: usize) -> Vec<usize> {
    let mut quota = vec![0; available.len()];
    let mut left = count;
    while left > 0 {
        let open: Vec<usize> = (0..quota.len())
            .filter(|&i| quota[i] < available[i])
            .collect();
        if open.is_empty() {
            break;
        }
        for i in open {
            if left > 0 {
                quota[i] += 1;
                left -= 1;
            }
        }
    }
    quota
}

#[cfg(test)]
mod tests {
    use super::quotas;

    #[test]
    fn shares_are_equal_and_what_is_missing_comes_from_the_others() {
        assert_eq!(quotas(&[10, 10, 10], 9), [3, 3, 3]);
        assert_eq!(quotas(&[1, 10, 10], 9), [1, 4, 4]);
        assert_eq!(quotas(&[1, 0, 2], 9), [1, 0, 2]);
        assert_eq!(quotas(&[], 9), [0; 0]);
    }
}
