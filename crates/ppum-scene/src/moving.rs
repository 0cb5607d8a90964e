//! Pictures in motion: the steps of a series, or the deformed plate with a factor that grows and falls. All have one range.

use ppum::dataset::Dataset;
use ppum::field::{Field, FieldError};
use ppum::progress::Watcher;
use ppum::vec2::Rect;
use ppum_figure::figure::{Design, plot_area};
use ppum_render::deform::AutomaticFactor;
use ppum_render::image::Image;
use ppum_render::picture::Style;
use ppum_render::view::View;

use crate::deformed::{self, Factor};
use crate::drawing::{classes, united};
use crate::scene::{Scene, SubjectError};
use crate::shared::{Coloring, Found};
use crate::shot::{ShotError, page_by, reshaped, title, uncolored};

/// What moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Moving {
    /// The pictures are these steps.
    Steps(Vec<usize>),
    /// The plate deforms up to so many times its displacement and back, in so many pictures.
    Factor(f64, usize),
}

/// The reason why there are no such pictures.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MovingError {
    /// A step that is not there.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A part or a replacement.
    #[error(transparent)]
    Subject(#[from] SubjectError),
    /// No pictures.
    #[error("a moving picture needs one step at least")]
    Empty,
    /// A picture.
    #[error(transparent)]
    Shot(Box<ShotError>),
}

impl From<ShotError> for MovingError {
    fn from(error: ShotError) -> Self {
        Self::Shot(Box::new(error))
    }
}

impl Moving {
    /// The number of pictures.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Steps(steps) => steps.len(),
            Self::Factor(_, count) => *count,
        }
    }

    /// The scene of a picture.
    fn scene(&self, scene: &Scene, number: usize) -> Scene {
        let mut scene = scene.clone();
        match self {
            Self::Steps(steps) => scene.subject.step = Some(steps[number]),
            Self::Factor(largest, count) => {
                let part = number as f64 / *count as f64;
                let share = 0.5 - 0.5 * (std::f64::consts::TAU * part).cos();
                scene.deformed = Some(Factor::Given(largest * share));
            }
        }
        scene
    }

    /// Draws the pictures, one after the other, and gives each to `take`: first all values, from which their one range follows, then
    /// the pictures. All have the pixels that the view has, or those that a design has room for.
    ///
    /// # Errors
    /// As those of one picture; a watcher that stops it.
    pub fn draw(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        view: &View,
        design: Option<&Design>,
        watcher: &dyn Watcher,
        take: &mut dyn FnMut(Image),
    ) -> Result<(), MovingError> {
        let scene = self.settled(dataset, scene)?;
        let view = match design {
            Some(design) => {
                reshaped(view, self.room(dataset, &scene, design)?).map_err(ShotError::from)?
            }
            None => *view,
        };
        self.draw_in(dataset, &scene, &view, design, watcher, take)
    }

    /// The same where the view is that of the pictures, pixel for pixel, and the factor of the deformed plate is a number.
    ///
    /// # Errors
    /// As [`Self::draw`].
    pub fn draw_in(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        view: &View,
        design: Option<&Design>,
        watcher: &dyn Watcher,
        take: &mut dyn FnMut(Image),
    ) -> Result<(), MovingError> {
        let coloring = self.coloring(dataset, scene, view, watcher)?;
        self.each(dataset, scene, |dataset, field, scene| {
            let page = page_by(&coloring, dataset, field, scene, view, design, watcher)?;
            take(page.image());
            Ok(())
        })
    }

    /// The scene with the factor of the deformed plate as a number, the same for all pictures.
    ///
    /// # Errors
    /// Fields that are no displacements.
    pub fn settled(&self, dataset: &Dataset, scene: &Scene) -> Result<Scene, MovingError> {
        let mut scene = scene.clone();
        if scene.deformed == Some(Factor::Auto) {
            let mut found = AutomaticFactor::default();
            self.each(dataset, &scene, |_, field, _| Ok(found.add(field, &field.domain.bounds)?))?;
            scene.deformed = Some(Factor::Given(found.factor()));
        }
        Ok(scene)
    }

    /// The box that shows the plate in all pictures.
    ///
    /// # Errors
    /// As [`deformed::bounds`].
    pub fn bounds(&self, dataset: &Dataset, scene: &Scene) -> Result<Rect, MovingError> {
        let mut all: Option<Rect> = None;
        self.each(dataset, scene, |_, field, scene| {
            let bounds = match scene.deformed {
                None => field.domain.bounds,
                Some(factor) => deformed::bounds(field, factor.number(&[field])?, scene.outline)?,
            };
            all = Some(all.map_or(bounds, |all| all.union(&bounds)));
            Ok(())
        })?;
        Ok(all.unwrap_or(dataset.domain.bounds))
    }

    /// Columns and rows that a design has room for under all titles.
    ///
    /// # Errors
    /// A design without room.
    pub fn room(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        design: &Design,
    ) -> Result<[u32; 2], MovingError> {
        let mut room = design.size;
        self.each(dataset, scene, |dataset, field, scene| {
            let [columns, rows] = plot_area(&title(dataset, field, scene)?, design)?;
            room = [room[0].min(columns), room[1].min(rows)];
            Ok(())
        })?;
        Ok(room)
    }

    /// One way to colours for all pictures.
    fn coloring(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        view: &View,
        watcher: &dyn Watcher,
    ) -> Result<Coloring, MovingError> {
        let (mut found, mut style_of, mut all) = (Found::default(), None, Vec::new());
        self.each(dataset, scene, |_, field, scene| {
            let (shown, drawn, style, span) = uncolored(field, scene, view, watcher)?;
            found.add(span, &drawn, style.scale);
            all.push(classes([(&shown, &drawn.values)]));
            style_of.get_or_insert(style);
            Ok(())
        })?;
        let style: Style = style_of.ok_or(MovingError::Empty)?;
        let classes = all.into_iter().collect::<Option<Vec<_>>>().and_then(united);
        Ok(found.coloring(scene.colors.classed(style.clone(), classes), style))
    }

    /// Does something for each picture, with its field.
    fn each(
        &self,
        dataset: &Dataset,
        scene: &Scene,
        mut work: impl FnMut(&Dataset, &Field<'_>, &Scene) -> Result<(), ShotError>,
    ) -> Result<(), MovingError> {
        for number in 0..self.count() {
            let scene = self.scene(scene, number);
            let mut changed = None;
            let dataset = match scene.subject.is_whole() {
                true => dataset,
                false => {
                    let changed = changed.insert(dataset.clone());
                    scene.subject.apply(changed)?;
                    changed
                }
            };
            let field = Field::new(dataset, scene.subject.step_of(dataset))?;
            work(dataset, &field, &scene)?;
        }
        Ok(())
    }
}
