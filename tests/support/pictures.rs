//! Heads and the device that draws them, for tests of pictures.

use londra::anatomy::{Breed, ParamTable, library};
use londra::frame::Pipeline;
use londra::render::{Gpu, Offscreen};
use londra::rig::Rig;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock};

/// One device for all tests, and one at a time: the software driver takes every core anyhow.
pub fn offscreen() -> MutexGuard<'static, Offscreen> {
    static DEVICE: OnceLock<Mutex<Offscreen>> = OnceLock::new();
    let device = DEVICE.get_or_init(|| {
        let gpu = Gpu::open_software().unwrap_or_else(|e| panic!("pictures cannot be tested here: {e}"));
        Mutex::new(Offscreen::new(gpu).unwrap_or_else(|e| panic!("shaders/{e}")))
    });
    let mut guard = device.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    guard.forget();
    guard
}

/// The table, and a pipeline of one level.
#[allow(dead_code)] // not every test file asks for heads
pub struct Heads {
    /// Of measures.
    pub table: Arc<ParamTable>,
    /// From breeds to frames.
    pub pipeline: Pipeline,
}

#[allow(dead_code)]
impl Heads {
    /// At a level of subdivision.
    pub fn new(level: u32) -> Self {
        let table = Arc::new(ParamTable::embedded().unwrap());
        let rig = Arc::new(Rig::embedded(&table).unwrap());
        Self { pipeline: Pipeline::new(rig, level).unwrap(), table }
    }

    /// A breed by id.
    pub fn breed(&self, id: &str) -> Breed {
        library::breed(&self.table, id).unwrap()
    }
}
