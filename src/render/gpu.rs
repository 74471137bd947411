//! The graphics device: opened once per run, shared by everything that draws.

use thiserror::Error;

/// Why nothing can be drawn on this machine.
#[derive(Clone, Debug, Error)]
pub enum GpuError {
    /// No driver offers an adapter.
    #[error(
        "no graphics adapter: install a Vulkan driver (on Debian and Ubuntu `apt install libvulkan1 mesa-vulkan-drivers` \
         brings a software one){hint} ({detail})"
    )]
    NoAdapter {
        /// What each backend answered.
        detail: String,
        /// Set when the environment variable `WGPU_BACKEND` narrows the choice; else empty.
        hint: String,
    },
    /// An adapter is there, but it gives no device.
    #[error("the graphics adapter {adapter} gives no device: {detail}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// The driver's reason.
        detail: String,
    },
}

/// An open device with its queue. Cloning shares it.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// Where the device comes from.
    pub adapter: wgpu::Adapter,
    /// Makes buffers, textures and pipelines.
    pub device: wgpu::Device,
    /// Takes work.
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// A device without a window: the driver's first choice. `WGPU_BACKEND` (`vulkan`, `gl`, …) narrows the choice.
    pub fn open() -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .map_err(|e| no_adapter(e.to_string()))?;
        Self::from_adapter(adapter)
    }

    /// A device of a software driver, for pictures that must come out the same on every machine.
    pub fn open_software() -> Result<Self, GpuError> {
        let mut wanted = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        if wgpu::Backends::from_env().is_none() {
            wanted.backends = wgpu::Backends::VULKAN;
        }
        let instance = wgpu::Instance::new(wanted);
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        let software = adapters.into_iter().find(|a| a.get_info().device_type == wgpu::DeviceType::Cpu);
        let adapter = software.ok_or_else(|| no_adapter("no software adapter among those offered".into()))?;
        Self::from_adapter(adapter)
    }

    /// A device that can draw to a window's surface.
    pub fn open_for(instance: &wgpu::Instance, surface: &wgpu::Surface<'_>) -> Result<Self, GpuError> {
        let options = wgpu::RequestAdapterOptions { compatible_surface: Some(surface), ..Default::default() };
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(|e| no_adapter(e.to_string()))?;
        Self::from_adapter(adapter)
    }

    /// Whether a processor does the work of a graphics card.
    pub fn is_software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }

    fn from_adapter(adapter: wgpu::Adapter) -> Result<Self, GpuError> {
        let descriptor = device_descriptor(&adapter);
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|e| GpuError::NoDevice { adapter: adapter.get_info().name, detail: e.to_string() })?;
        Ok(Self { adapter, device, queue })
    }

    /// Backend and adapter name, for people.
    pub fn name(&self) -> String {
        let info = self.adapter.get_info();
        format!("{} ({})", info.name, info.backend)
    }
}

/// What a device is asked for: the defaults, or less where only GL is to be had. No optional feature is used.
fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let limits = if adapter.get_info().backend == wgpu::Backend::Gl {
        wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits())
    } else {
        wgpu::Limits::default()
    };
    wgpu::DeviceDescriptor { label: Some("londra"), required_limits: limits, ..Default::default() }
}

fn no_adapter(detail: String) -> GpuError {
    let hint = match std::env::var("WGPU_BACKEND") {
        Ok(value) => format!(", or unset WGPU_BACKEND, which is `{value}`"),
        Err(_) => String::new(),
    };
    GpuError::NoAdapter { detail, hint }
}
