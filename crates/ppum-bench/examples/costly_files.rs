//! Writes the small files that ask for much into a folder: `costly_files FOLDER`.

use std::error::Error;
use std::path::Path;

use ppum_testkit::costly;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: costly_files FOLDER")?;
    std::fs::create_dir_all(&folder)?;
    for (name, dataset) in costly::all() {
        let bytes = ppum_format::Arrays::of(&dataset)?.to_bytes()?;
        println!("{:>7} bytes  {name}", bytes.len());
        std::fs::write(Path::new(&folder).join(format!("{name}.h5")), bytes)?;
    }
    Ok(())
}
