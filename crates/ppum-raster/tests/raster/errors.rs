//! Errors can be carried from thread to thread.

ppum_testkit::errors_cross_threads!(ppum_raster::RenderError, ppum_raster::view::ViewError);
