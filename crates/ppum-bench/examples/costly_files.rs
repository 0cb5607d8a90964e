//! Writes the small files that ask for much into a folder: `costly_files FOLDER [NAME …]`.

use std::error::Error;
use std::path::Path;

use ppum_testkit::costly;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, names @ ..] = arguments.as_slice() else {
        return Err("usage: costly_files FOLDER [NAME …]".into());
    };
    std::fs::create_dir_all(folder)?;
    let is_wanted = |name: &str| names.is_empty() || names.iter().any(|wanted| wanted == name);
    for file in costly::chosen(|name, _| is_wanted(name)) {
        let bytes = ppum_format::damage::unchecked(&file.dataset)?;
        println!("{:>7} bytes  {}", bytes.len(), file.name);
        std::fs::write(Path::new(folder).join(format!("{}.h5", file.name)), bytes)?;
    }
    Ok(())
}
