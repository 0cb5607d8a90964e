//! Draws a request as the window saves it, and prints the command that the window shows for it:
//! `export FILE.h5 REQUEST.json OUT.png`. Tests hold it to the program and to Python.

use std::error::Error;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

use ppum::progress::unwatched;
use ppum::vec2::Vec2;
use ppum_render::view::View;
use ppum_scene::request::Request;
use ppum_viewer::export::{ExportChoice, ImageExport, Motion, PageSize};
use ppum_viewer::field::OwnedField;

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = std::env::args_os().skip(1).map(PathBuf::from);
    let mut path = || paths.next().ok_or("give FILE.h5 REQUEST.json OUT.png");
    let [file, request, output] = [path()?, path()?, path()?];
    let request: Request = serde_json::from_str(&std::fs::read_to_string(request)?)?;
    let mut dataset = ppum_format::read(&file)?;
    request.scene.subject.apply(&mut dataset)?;
    let step = request.scene.subject.step_of(&dataset);
    let size = request.look.size.ok_or("a request without a size")?;
    let center = request.place.center.map(Vec2::from).ok_or("a request without a centre")?;
    let width = request.place.width.ok_or("a request without a width")?;
    let order = ImageExport {
        field: Arc::new(OwnedField::new(Arc::new(dataset), step)?),
        file: Some(file),
        left: None,
        scene: request.scene,
        view: View::new(center, width, size)?,
        page: PageSize::pixels(size),
        choice: if request.figure { ExportChoice::Figure } else { ExportChoice::Image },
        motion: Motion::default(),
        texts: request.labels,
    };
    let (bytes, notices) = order.bytes(&output, unwatched(), &AtomicUsize::new(0))?;
    std::fs::write(&output, bytes)?;
    notices.iter().for_each(|notice| eprintln!("{}", notice.line()));
    println!("{}", order.command(&output)?);
    Ok(())
}
