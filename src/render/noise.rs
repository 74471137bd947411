//! A block of white noise that the shaders sample: once per device, the same on every machine.

/// Side of the block, texels; it repeats.
const SIDE: u32 = 64;

/// Four independent 8-bit values a texel, x fastest.
fn texels() -> Vec<u8> {
    (0..SIDE * SIDE * SIDE).flat_map(|i| scramble(i).to_le_bytes()).collect()
}

/// A bijection on 32 bits without visible pattern: multiplications and xor-shifts, the "lowbias32" constants that
/// Christopher Wellons found by search (2018).
fn scramble(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// The block as a texture.
pub(super) fn texture(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let size = wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: SIDE };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("noise"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D3,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    queue.write_texture(
        texture.as_image_copy(),
        &texels(),
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIDE * 4), rows_per_image: Some(SIDE) },
        size,
    );
    texture.create_view(&Default::default())
}

#[cfg(test)]
mod tests {
    #[test]
    fn noise_is_balanced_in_every_channel() {
        let texels = super::texels();
        for channel in 0..4 {
            let values = texels.iter().skip(channel).step_by(4).map(|&b| f64::from(b));
            let mean = values.sum::<f64>() / (texels.len() / 4) as f64;
            assert!((mean - 127.5).abs() < 1.0, "channel {channel}: {mean}");
        }
    }
}
