//! From one half of a mesh to the whole: the half, in its order, followed by the mirror images of its vertices off the
//! median plane.

use glam::Vec3;

/// For each half vertex, its number on the other side in the whole mesh; itself in the median plane (`midline`: one for
/// each half vertex).
pub(super) fn images(midline: &[bool]) -> Vec<u32> {
    let mut next = midline.len() as u32;
    let image = |(v, &mid): (usize, &bool)| {
        if mid {
            v as u32
        } else {
            next += 1;
            next - 1
        }
    };
    midline.iter().enumerate().map(image).collect()
}

/// Triangles of the whole mesh: the half's, then their mirror images.
pub(super) fn triangles(midline: &[bool], half: &[[u16; 3]]) -> Vec<[u32; 3]> {
    let images = images(midline);
    let left = half.iter().map(|f| f.map(u32::from));
    let right = half.iter().map(|&[a, b, c]| [a, c, b].map(|v| images[v as usize]));
    left.chain(right).collect()
}

/// Writes the whole mesh's positions (`whole`: emptied first) from the half's.
pub(super) fn unfold(midline: &[bool], half: &[Vec3], whole: &mut Vec<Vec3>) {
    whole.clear();
    whole.extend_from_slice(half);
    let off = half.iter().zip(midline).filter(|(_, middle)| !**middle);
    whole.extend(off.map(|(p, _)| Vec3::new(-p.x, p.y, p.z)));
}

/// Number of vertices of the whole mesh.
pub(super) fn n_whole(midline: &[bool]) -> usize {
    midline.len() + midline.iter().filter(|mid| !**mid).count()
}
