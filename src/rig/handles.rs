//! The control mesh's vertices by their place in the patches, so that the shape can speak of "ring 3, column 9".

use super::control::{ControlError, HalfMesh};
use std::collections::BTreeMap;

/// Stands for a place of a patch where there is no vertex.
pub const NONE: u16 = u16::MAX;

/// Half vertices by patch; the patches are explained in `assets/head.patch.ron`.
#[derive(Clone, Debug)]
#[allow(missing_docs)] // named as the patches
pub struct Handles {
    pub s: [[u16; 10]; 20],
    pub l: [[u16; 15]; 20],
    pub mu: [[u16; 4]; 11],
    pub ml: [[u16; 4]; 11],
    pub n: [u16; 10],
    pub nm: [u16; 2],
    pub nr: [u16; 10],
    pub ni: [u16; 10],
    pub np: u16,
    pub orbit: [u16; 12],
    pub of: [u16; 12],
    pub er: [u16; 12],
    pub ei: [u16; 12],
    pub ep: u16,
    pub ear_base: [u16; 12],
    pub a: [[u16; 12]; 5],
    pub a5: [u16; 8],
}

impl Handles {
    /// Looks every name up once.
    ///
    /// # Errors
    /// Names the first vertex that the shape needs and the mesh lacks.
    pub fn new(half: &HalfMesh) -> Result<Self, ControlError> {
        let index: BTreeMap<&str, u16> = half.tags.iter().enumerate().map(|(v, t)| (t.as_str(), v as u16)).collect();
        let get = |tag: String| index.get(tag.as_str()).copied().ok_or(ControlError::Missing(tag));
        let may = |tag: String| index.get(tag.as_str()).copied().unwrap_or(NONE);
        fn row<const N: usize>(
            get: &impl Fn(String) -> Result<u16, ControlError>,
            name: &str,
        ) -> Result<[u16; N], ControlError> {
            let mut out = [NONE; N];
            for (k, v) in out.iter_mut().enumerate() {
                *v = get(format!("{name}.{k}"))?;
            }
            Ok(out)
        }
        let named = |name: &str| -> Result<[u16; 12], ControlError> {
            let l = half.loops.get(name).ok_or(ControlError::Missing(name.to_owned()))?;
            l.as_slice().try_into().map_err(|_| ControlError::Missing(format!("{name} of 12 vertices")))
        };
        let mut s = [[NONE; 10]; 20];
        let mut l = [[NONE; 15]; 20];
        let (mut mu, mut ml) = ([[NONE; 4]; 11], [[NONE; 4]; 11]);
        for i in 0..20 {
            for (j, v) in s[i].iter_mut().enumerate() {
                *v = may(format!("s.{i}.{j}"));
            }
            if i >= 3 {
                for (j, v) in l[i].iter_mut().enumerate().skip(9) {
                    *v = if j == 9 && i >= 10 { s[i][9] } else { get(format!("l.{i}.{j}"))? };
                }
            }
        }
        for i in 3..11 {
            (mu[i][0], ml[i][0]) = (s[i][9], l[i][9]);
            for p in 1..4 {
                mu[i][p] = get(format!("mu.{i}.{p}"))?;
                ml[i][p] = get(format!("ml.{i}.{p}"))?;
            }
        }
        Ok(Self {
            s,
            l,
            mu,
            ml,
            n: row(&get, "n")?,
            nm: row(&get, "nm")?,
            nr: row(&get, "nr")?,
            ni: row(&get, "ni")?,
            np: get("np".into())?,
            orbit: named("orbit")?,
            of: row(&get, "of")?,
            er: row(&get, "er")?,
            ei: row(&get, "ei")?,
            ep: get("ep".into())?,
            ear_base: named("ear_base")?,
            a: [row(&get, "a0")?, row(&get, "a1")?, row(&get, "a2")?, row(&get, "a3")?, row(&get, "a4")?],
            a5: row(&get, "a5")?,
        })
    }
}
