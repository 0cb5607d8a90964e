//! A page as PDF 1.7.
//!
//! ```text
//! catalogue ── pages ── page ─┬─ content
//!                             └─ resources ─┬─ font ── letters, file, text of each letter
//!                                           ├─ images ── opacity
//!                                           └─ states: opacity of fills and strokes
//! ```

mod content;
mod file;
mod font;
mod image;

use pdf_writer::{Content, Finish as _, Name, Rect, TextStr};
use ppum::printable::printable;
use ppum_render::png::TextChunk;

use super::Canvas;
use content::PdfWriter;
use file::File;

/// Writes a page.
pub(super) fn file(canvas: &Canvas, dpi: f64, texts: &[TextChunk]) -> Vec<u8> {
    let [width, height] = canvas.size.map(|n| (f64::from(n) * 72.0 / dpi) as f32);
    let mut file = File::new();
    let [catalogue, pages, page, content] = [(); 4].map(|()| file.place());
    // pixels from the upper left corner
    let scale = (72.0 / dpi) as f32;
    let mut start = Content::new();
    start.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
    let mut writer = PdfWriter::new(&mut file, start);
    writer.page(canvas);
    let (operators, resources) = writer.finish();
    let font = resources.font.write(&mut file);

    file.pdf.catalog(catalogue).pages(pages);
    file.pdf.pages(pages).kids([page]).count(1);
    let mut record = file.pdf.page(page);
    record.parent(pages).media_box(Rect::new(0.0, 0.0, width, height)).contents(content);
    let mut listed = record.resources();
    if let Some(font) = font {
        listed.fonts().pair(font::NAME, font);
    }
    let mut images = listed.x_objects();
    for (name, place) in &resources.images {
        images.pair(Name(name.as_bytes()), *place);
    }
    images.finish();
    let mut states = listed.ext_g_states();
    for (name, share) in &resources.states {
        let mut state = states
            .insert(Name(name.as_bytes()))
            .start::<pdf_writer::writers::ExtGraphicsState<'_>>();
        state.stroking_alpha(*share).non_stroking_alpha(*share);
    }
    states.finish();
    listed.finish();
    record.finish();
    file.stream(content, &operators);
    describe(&mut file, texts);
    file.pdf.finish()
}

/// The document's information.
fn describe(file: &mut File, texts: &[TextChunk]) {
    let place = file.place();
    let mut about = file.pdf.document_info(place);
    for (key, text) in texts {
        let text = printable(text);
        match key.as_str() {
            "Title" => about.title(TextStr(&text)),
            "Software" => about.creator(TextStr(&text)),
            "Description" => about.subject(TextStr(&text)),
            key => {
                about.pair(Name(key.as_bytes()), TextStr(&text));
                &mut about
            }
        };
    }
}
