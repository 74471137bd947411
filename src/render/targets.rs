//! The textures a picture is drawn into: once per size.

/// Samples per pixel.
pub(super) const SAMPLES: u32 = 4;
/// Depth of every pass.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Colour of every pass. The shaders write sRGB-encoded values themselves, so that a file and the window, whose
/// widgets blend encoded values, show the same picture.
pub(super) const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// How a pass of the picture tests and writes depth.
pub(super) fn depth(writes: bool, compare: wgpu::CompareFunction) -> Option<wgpu::DepthStencilState> {
    Some(wgpu::DepthStencilState {
        format: DEPTH,
        depth_write_enabled: Some(writes),
        depth_compare: Some(compare),
        stencil: Default::default(),
        bias: Default::default(),
    })
}

/// The samples of every pass of the picture.
pub(super) fn samples() -> wgpu::MultisampleState {
    wgpu::MultisampleState { count: SAMPLES, ..Default::default() }
}

/// Multisampled colour and depth, and the resolved colour that can be copied or shown.
#[derive(Debug)]
pub struct Targets {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The finished picture: sRGB-encoded, premultiplied alpha.
    pub colour: wgpu::Texture,
    /// A view of it.
    pub colour_view: wgpu::TextureView,
    multisampled: wgpu::TextureView,
    depth: wgpu::TextureView,
}

impl Targets {
    /// `size`: pixels, each at least 1 and at most the device's limit.
    pub fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let texture = |label, format, sample_count, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let shown = attachment | wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::TEXTURE_BINDING;
        let colour = texture("colour", COLOUR, 1, shown);
        let multisampled = texture("multisampled colour", COLOUR, SAMPLES, attachment);
        let depth = texture("depth", DEPTH, SAMPLES, attachment);
        Self {
            size,
            colour_view: colour.create_view(&Default::default()),
            colour,
            multisampled: multisampled.create_view(&Default::default()),
            depth: depth.create_view(&Default::default()),
        }
    }

    /// Begins the one pass of a picture, cleared to nothing.
    pub(super) fn begin<'e>(&self, encoder: &'e mut wgpu::CommandEncoder) -> wgpu::RenderPass<'e> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.multisampled,
                depth_slice: None,
                resolve_target: Some(&self.colour_view),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }
}
