//! Errors can be carried from thread to thread.

ppum_testkit::errors_cross_threads!(ppum_raster::RasterError, ppum_raster::view::ViewError);
