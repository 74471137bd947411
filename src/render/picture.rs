//! Pixels in memory: straight-alpha sRGB bytes, row by row from the top left.

/// An RGBA picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Four bytes a pixel (sRGB red, green, blue, straight alpha); length: 4 · width · height.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// One colour all over.
    pub fn filled(width: u32, height: u32, rgba: [u8; 4]) -> Self {
        let n_pixels = width as usize * height as usize;
        Self { width, height, rgba: rgba.repeat(n_pixels) }
    }

    /// Replaces the pixels under `other`, whose top left corner comes to (x, y); what hangs over is cut.
    pub fn paste(&mut self, other: &Self, x: u32, y: u32) {
        let columns = other.width.min(self.width.saturating_sub(x)) as usize;
        for row in 0..other.height.min(self.height.saturating_sub(y)) {
            let to = ((y + row) as usize * self.width as usize + x as usize) * 4;
            let from = row as usize * other.width as usize * 4;
            self.rgba[to..to + columns * 4].copy_from_slice(&other.rgba[from..from + columns * 4]);
        }
    }

    /// So many times narrower and lower, each pixel the mean of a square of `side` by `side` (at least 1); what is left
    /// over at the last row and column is dropped.
    pub fn reduced(&self, side: u32) -> Self {
        let (width, height) = (self.width / side, self.height / side);
        let (side, stride) = (side as usize, self.width as usize);
        let n = (side * side) as u32;
        let mut rgba = Vec::with_capacity(width as usize * height as usize * 4);
        for y in 0..height as usize {
            for x in 0..width as usize {
                let mut sums = [0; 3];
                let mut alpha = 0;
                for row in y * side..(y + 1) * side {
                    let block = &self.rgba[4 * (row * stride + x * side)..][..4 * side];
                    for pixel in block.as_chunks::<4>().0 {
                        let [colour @ .., a] = pixel.map(u32::from);
                        (0..3).for_each(|i| sums[i] += colour[i] * a);
                        alpha += a;
                    }
                }
                rgba.extend(sums.map(|sum| (sum + alpha / 2).checked_div(alpha).unwrap_or(0) as u8));
                rgba.push(((alpha + n / 2) / n) as u8);
            }
        }
        Self { width, height, rgba }
    }

    /// A PNG file. The same pixels give the same bytes.
    pub fn to_png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.rgba)?;
        writer.finish()?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paste_over_the_edge_is_cut() {
        let mut below = Picture::filled(4, 4, [0, 0, 0, 255]);
        below.paste(&Picture::filled(3, 3, [255; 4]), 2, 3);
        assert_eq!(below.rgba.iter().filter(|&&b| b == 255).count(), 14 + 2 * 4);
    }

    #[test]
    fn a_smaller_picture_weighs_colours_without_their_alpha() {
        let picture = Picture { width: 2, height: 2, rgba: [[200, 0, 0, 255], [0; 4], [0; 4], [0; 4]].concat() };
        assert_eq!(picture.reduced(2).rgba, [200, 0, 0, 64]);
    }
}
