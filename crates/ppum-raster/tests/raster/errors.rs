//! Errors can be carried from thread to thread.

#[test]
fn errors_cross_threads() {
    fn check<E: std::error::Error + Send + Sync + 'static>() {}
    check::<ppum_raster::RenderError>();
    check::<ppum_raster::view::ViewError>();
}
