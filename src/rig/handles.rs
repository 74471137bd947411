//! The control mesh's vertices by their place in the patches, so that the shape can speak of "ring 3, column 9".

use super::control::{ControlError, HalfMesh};
use std::collections::BTreeMap;

/// Stands for a place of a patch where there is no vertex.
pub const NONE: u16 = u16::MAX;

/// Rings of twelve vertices around the ear's leather; one of eight closes it.
pub const EAR_RINGS: usize = 8;

/// Half vertices by patch; the patches are explained in `assets/head.patch.ron`.
#[derive(Clone, Debug)]
pub struct Handles {
    /// Upper skin: ring, column.
    pub s: [[u16; 10]; 20],
    /// Lower skin: ring, column.
    pub l: [[u16; 15]; 20],
    /// Upper lining of the mouth: row, place from the lip inwards.
    pub mu: [[u16; 4]; 11],
    /// Lower lining of the mouth: row, place from the lip inwards.
    pub ml: [[u16; 4]; 11],
    /// Rim of the nose pad.
    pub n: [u16; 10],
    /// Midline of the nose pad.
    pub nm: [u16; 2],
    /// Rim of the nostril.
    pub nr: [u16; 10],
    /// Inside of the nostril.
    pub ni: [u16; 10],
    /// End of the nostril.
    pub np: u16,
    /// The hole of the grid around the eye.
    pub orbit: [u16; 12],
    /// Fold of the lids.
    pub of: [u16; 12],
    /// Outer margin of the lids.
    pub er: [u16; 12],
    /// Inner margin of the lids.
    pub ei: [u16; 12],
    /// Pole behind the eyeball.
    pub ep: u16,
    /// The hole of the grid below the ear.
    pub ear_base: [u16; 12],
    /// Rings of the ear from its base: ring, place around.
    pub a: [[u16; 12]; EAR_RINGS],
    /// Last ring of the ear.
    pub ear_end: [u16; 8],
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
        let mut a = [[NONE; 12]; EAR_RINGS];
        for (r, ring) in a.iter_mut().enumerate() {
            *ring = row(&get, &format!("a{r}"))?;
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
            a,
            ear_end: row(&get, &format!("a{EAR_RINGS}"))?,
        })
    }
}
