//! Several quantities, or parts of a field, in one figure.

use anyhow::{Context as _, ensure};
use ppum_figure::figure::{
    Design, FigureError, Labels, PanelGrid, lacks_legend, panel_area, panels,
};
use ppum_render::range::ValueSpan;

use super::{Args, Sheet, Still, deformation_note};
use crate::given::Given;
use crate::look::{DEFAULT_SIZE, LookArgs, letters};
use ppum_scene::drawing::{BodyView, Drawn};
use ppum_scene::engine::Engine;
use ppum_scene::moving::FrameView as _;
use ppum_scene::range::Telling;
use ppum_scene::shared::Coloring;
use ppum_scene::shot::{Asked, FieldSource, Input, Shot, tell_legend, title};

/// What a panel shows, and of which plate; several parts of a field are several plates.
struct PanelContent<'a> {
    still: Still<'a>,
    asked: Asked,
}

impl Args {
    /// Draws each quantity of each plate in a panel.
    pub(super) fn panels(
        &self,
        sources: &[FieldSource<'_>],
        engine: &Engine<'_>,
    ) -> anyhow::Result<Sheet> {
        let source = sources[0];
        let (dataset, field) = (source.dataset, source.field);
        let parts = self.parts(sources)?;
        let still = &parts[0].still;
        let labels = self.labels(&parts, sources.len())?;
        let captions: Vec<&str> = labels.iter().map(|labels| labels.title.as_str()).collect();
        let titled = title(source, &still.request)?;
        let grid = self.grid(&titled, &captions, sources)?;
        let size = [grid.columns, grid.rows];
        let design = self.design(field, LookArgs::page(self.window.aspect(field), size), size);
        let room = panel_area(&titled, &captions, grid, &design)?;
        let seen = self.placing(still, self.frame(room, &design))?;
        let seen = seen.seen(source, &still.request, engine)?;
        let shots = self.shots(&parts, &seen, &design, engine)?;
        let all: Vec<_> = shots.iter().zip(&labels).map(|(s, l)| s.panel(l.clone())).collect();
        let lacking = all.iter().filter(|panel| lacks_legend(panel, room, &design));
        lacking.for_each(|panel| tell_legend(&panel.legend, engine));
        let page = panels(&titled, &all, grid, &design)?;
        let names = parts.iter().step_by(sources.len()).map(|part| part.asked.name.as_str());
        let names = names.collect::<Vec<_>>().join(", ");
        let mut texts =
            shots[0].picture.description(&dataset.title, &self.subject.file_name(), &names);
        if !self.shared_range {
            // each panel has its own, on its bar
            let is_own =
                |key: &str| ["ppum:range", "ppum:range-basis", "ppum:extrema"].contains(&key);
            texts.retain(|(key, _)| !is_own(key));
        }
        texts.push(("ppum:backend".to_owned(), shots[0].by.clone()));
        texts.extend(self.subject.replacements.notes().chain(shots[0].notes()));
        let ([columns, rows], captions) = (page.size, self.subject.replacements.captions());
        let names = [names].into_iter().chain(captions).collect::<Vec<_>>().join(", ");
        let (moved, by) = (deformation_note(&shots[0]), &shots[0].by);
        let colors = self.colors(&Telling::new(dataset, field), &labels, &shots);
        let told = format!("{names}{moved}, {columns}x{rows} pixels, {by}{colors}");
        Ok(Sheet { page, texts, told })
    }

    /// What the panels show: all parts of a quantity, then those of the next one.
    fn parts<'a>(&self, sources: &[FieldSource<'a>]) -> anyhow::Result<Vec<PanelContent<'a>>> {
        let texts = match self.subject.texts()? {
            Some(texts) => texts.into_iter().map(Some).collect(),
            None => vec![None],
        };
        let part = |text: &Option<Given>, source: FieldSource<'a>| {
            let mut still = Still { source, request: self.request(self.subject.step) };
            still.request.scene.quantity = self.quantity(source.field, text.as_ref())?;
            still.settle()?;
            let asked = Asked::new(&still.request.scene, source.field)?;
            Ok(PanelContent { still, asked })
        };
        let of = |text| sources.iter().map(move |&source| part(text, source));
        texts.iter().flat_map(of).collect()
    }

    /// The pictures of all panels, of one range if that is asked for.
    fn shots(
        &self,
        parts: &[PanelContent<'_>],
        seen: &BodyView<'_>,
        design: &Design,
        engine: &Engine<'_>,
    ) -> anyhow::Result<Vec<Shot>> {
        let inputs: Vec<_> =
            parts.iter().map(|part| part.still.source.input(&part.asked, seen)).collect();
        let drawn = inputs.iter().map(|input| {
            let drawn = input.values(self.samples, engine)?;
            input.tell_values(&drawn, engine);
            Ok(drawn)
        });
        let drawn = drawn.collect::<anyhow::Result<Vec<_>>>()?;
        let colorings = self.colorings(&inputs, &drawn, engine)?;
        let shots = parts.iter().zip(&inputs).zip(drawn.iter().zip(&colorings));
        let shot = |((part, input), (drawn, coloring)): ((&PanelContent<'_>, &Input<'_>), _)| {
            Ok(input.shot(&part.still.request, drawn, coloring, Some(design), engine)?)
        };
        shots.map(shot).collect()
    }

    /// The arrangement: as given; else a row for each of several quantities of several parts, or
    /// that with the largest pictures.
    fn grid(
        &self,
        title: &str,
        captions: &[&str],
        sources: &[FieldSource<'_>],
    ) -> anyhow::Result<PanelGrid> {
        let (count, parts, shared_bar) = (captions.len(), sources.len(), self.shared_range);
        let of = |columns: usize| {
            let size = [columns as u32, count.div_ceil(columns) as u32];
            PanelGrid { shared_bar, ..PanelGrid::new(size) }
        };
        if let Some([columns, rows]) = self.layout {
            ensure!(columns.min(rows) > 0, "--layout: give at least 1x1 panels");
            let grid = PanelGrid { shared_bar, ..PanelGrid::new([columns, rows]) };
            ensure!(
                count <= grid.cells(),
                "--layout {columns}x{rows} has fewer panels than there are pictures, {count}"
            );
            return Ok(grid);
        }
        if parts > 1 && count > parts {
            return Ok(of(parts));
        }
        let field = sources[0].field;
        let aspect = self.window.aspect(field);
        let width = |grid: PanelGrid| {
            let design = self.design(field, DEFAULT_SIZE, [grid.columns, grid.rows]);
            let [width, height] = panel_area(title, captions, grid, &design)?.map(f64::from);
            Ok::<_, FigureError>(width.min(height * aspect.unwrap_or(SHAPE)))
        };
        let fitting = (1..=count).filter_map(|n| Some((width(of(n)).ok()?, of(n))));
        let best = fitting.reduce(|a, b| if b.0 > a.0 { b } else { a });
        best.map_or_else(|| Ok(width(of(count)).map(|_| of(count))?), |(_, grid)| Ok(grid))
    }

    /// The words of the panels, `(a) σ_yy` above the first; where one bar is for all it names what
    /// they share.
    fn labels(&self, all: &[PanelContent<'_>], parts: usize) -> anyhow::Result<Vec<Labels>> {
        let captions = self.subject.replacements.captions();
        let is_one = all.len() == parts;
        let of = |(number, part): (usize, &PanelContent<'_>)| {
            let [name, _] = part.asked.shown.words(part.still.source.field);
            let mut labels = part.still.source.labels(&part.asked.shown, &part.still.request)?;
            if self.shared_range && !is_one && self.look.texts().bar.is_none() {
                labels.quantity.clear();
            }
            let caption = match captions.get(number % parts) {
                Some(part) if is_one => part.clone(),
                Some(part) => format!("{name}, {part}"),
                None => name,
            };
            labels.title = format!("({}) {caption}", letters(number));
            Ok(labels)
        };
        all.iter().enumerate().map(of).collect()
    }

    /// What the colours of each panel mean, in lines of their own; those of one range once.
    fn colors(&self, telling: &Telling<'_>, labels: &[Labels], shots: &[Shot]) -> String {
        let has_parts = self.subject.has_parts();
        let line = |(shot, labels): (&Shot, &Labels)| {
            let letter = labels.title.split(' ').next().filter(|_| has_parts).unwrap_or_default();
            let name = format!("{letter} {}", shot.name);
            format!("\n  {}: {}", name.trim_start(), telling.colors(&shot.picture))
        };
        match shots.first() {
            Some(first) if self.shared_range => format!("\n  {}", telling.colors(&first.picture)),
            _ => shots.iter().zip(labels).map(line).collect(),
        }
    }

    /// The ways to colours, of one range for all if that is asked for.
    fn colorings(
        &self,
        inputs: &[Input<'_>],
        drawn: &[Drawn],
        engine: &Engine<'_>,
    ) -> anyhow::Result<Vec<Coloring>> {
        let colors = self.colours.chosen();
        let all = inputs.iter().zip(drawn);
        if !self.shared_range {
            return all.map(|(input, drawn)| Ok(input.coloring(&colors, drawn, engine)?)).collect();
        }
        let map = colors.map(inputs[0].shown.quantity())?;
        let style = colors.style_of(all.clone().map(|(i, drawn)| (i.shown, &drawn.values)), map);
        let spans = all.map(|(input, drawn)| input.span(drawn, &style, engine));
        let spans = spans.collect::<Result<Vec<_>, _>>()?;
        let span =
            ValueSpan::shared(&spans, style.colormap.diverging).context("there is a range")?;
        Ok(vec![Coloring { style, span, ends: None }; inputs.len()])
    }
}

/// Width over height of pictures that have any shape.
const SHAPE: f64 = 4.0 / 3.0;
