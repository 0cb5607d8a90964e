//! The palette that images share.
//!
//! Colours are cut into boxes by their medians, the box with the largest sum of squared distances
//! first \[P. Heckbert, Color image quantization for frame buffer display, SIGGRAPH 1982\]. Where
//! there are no more colours than places each has a box of its own.

use std::collections::BTreeMap;
use std::fmt;

use crate::image::{Image, Rgba};

/// The place of what is transparent.
pub(super) const TRANSPARENT: u8 = 255;
/// Places of colours.
const PLACES: usize = 255;

/// A colour and how often it is there.
type ColorCount = ([u8; 3], u64);

/// Colours, and the place of each that was seen.
pub(super) struct GifPalette {
    colors: Vec<[u8; 3]>,
    places: BTreeMap<[u8; 3], u8>,
}

impl GifPalette {
    /// The palette of colours that were counted.
    pub(super) fn new(colors: &ColorCounts) -> Self {
        let mut boxes = vec![ColorBox::new(colors.counted())];
        while boxes.len() < PLACES {
            let wide = boxes.iter().enumerate().filter(|(_, b)| b.spread > 0.0);
            let Some((widest, _)) = wide.max_by(|a, b| a.1.spread.total_cmp(&b.1.spread)) else {
                break;
            };
            let parts = boxes.swap_remove(widest).halves();
            boxes.extend(parts);
        }
        let colors: Vec<_> = boxes.iter().map(ColorBox::mean).collect();
        let members = boxes.iter().zip(0..=u8::MAX);
        let members = members.flat_map(|(b, place)| b.colors.iter().map(move |c| (c.0, place)));
        Self { places: members.collect(), colors }
    }

    /// Red, green and blue of the 256 places.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut bytes = self.colors.concat();
        bytes.resize(3 * 256, 0);
        bytes
    }

    /// The place of a colour, or of the nearest if it was not counted.
    fn place(&self, color: [u8; 3]) -> u8 {
        let apart = |other: &[u8; 3]| -> u32 {
            color.iter().zip(other).map(|(a, b)| u32::from(a.abs_diff(*b)).pow(2)).sum()
        };
        let nearest = || {
            let all = self.colors.iter().zip(0..=u8::MAX);
            all.min_by_key(|(other, _)| apart(other)).map_or(TRANSPARENT, |(_, place)| place)
        };
        self.places.get(&color).copied().unwrap_or_else(nearest)
    }

    /// The place of each pixel's colour.
    pub(super) fn indices(&self, image: &Image) -> Vec<u8> {
        let mut last = ([0; 3], None);
        let mut place = |color: [u8; 3]| {
            if last.1.is_none() || last.0 != color {
                last = (color, Some(self.place(color)));
            }
            last.1.unwrap_or(TRANSPARENT)
        };
        let pixels = image.rgba.as_chunks::<4>().0;
        pixels.iter().map(|p| opaque(*p).map_or(TRANSPARENT, &mut place)).collect()
    }
}

/// The colour of a pixel that is not transparent.
fn opaque([red, green, blue, opacity]: Rgba) -> Option<[u8; 3]> {
    (opacity >= 128).then_some([red, green, blue])
}

/// The colours of images, counted one image after the other: 64 MiB, however many there are.
#[derive(Clone)]
pub struct ColorCounts {
    /// The number of pixels of each colour.
    counts: Vec<u32>,
    has_transparent: bool,
}

impl fmt::Debug for ColorCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Colors").finish_non_exhaustive()
    }
}

impl Default for ColorCounts {
    fn default() -> Self {
        Self::new()
    }
}

impl ColorCounts {
    /// No colours.
    #[must_use]
    pub fn new() -> Self {
        Self { counts: vec![0; 1 << 24], has_transparent: false }
    }

    /// Counts those of an image.
    pub fn add(&mut self, image: &Image) {
        for pixel in image.rgba.as_chunks::<4>().0 {
            match opaque(*pixel) {
                None => self.has_transparent = true,
                Some([red, green, blue]) => {
                    let at = usize::from(red) << 16 | usize::from(green) << 8 | usize::from(blue);
                    self.counts[at] = self.counts[at].saturating_add(1);
                }
            }
        }
    }

    /// True if a pixel of an image was transparent.
    pub(super) fn has_transparent(&self) -> bool {
        self.has_transparent
    }

    fn counted(&self) -> Vec<ColorCount> {
        let there = (0u32..).zip(&self.counts).filter(|(_, count)| **count > 0);
        let color = |bits: u32| [bits >> 16, bits >> 8, bits].map(|channel| channel as u8);
        there.map(|(bits, count)| (color(bits), u64::from(*count))).collect()
    }
}

/// Colours of one box.
struct ColorBox {
    colors: Vec<ColorCount>,
    /// The channel in which they differ most.
    channel: usize,
    /// The sum of their squared distances from the mean in that channel.
    spread: f64,
}

/// Every colour counts, and often seen ones more, by the power of 3/4: with the number itself rare
/// colours, those of lines and letters, were off by half as much again, with its root slopes had
/// half as many steps.
fn weight((_, count): &ColorCount) -> f64 {
    let root = (*count as f64).sqrt();
    root * root.sqrt()
}

impl ColorBox {
    fn new(colors: Vec<ColorCount>) -> Self {
        let spreads = [0, 1, 2].map(|channel| (channel, spread(&colors, channel)));
        let widest = spreads.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let (channel, spread) = widest.unwrap_or((0, 0.0));
        Self { colors, channel, spread }
    }

    /// Two parts of more than one colour, at the mean of the channel in which they differ most.
    fn halves(self) -> [Self; 2] {
        let Self { mut colors, channel, .. } = self;
        colors.sort_by_key(|(color, _)| (color[channel], *color));
        let mean = mean(&colors, channel);
        let at = colors.partition_point(|c| f64::from(c.0[channel]) <= mean);
        let upper = colors.split_off(at.clamp(1, colors.len() - 1));
        [colors, upper].map(Self::new)
    }

    /// The mean colour; of a single colour that one.
    fn mean(&self) -> [u8; 3] {
        [0, 1, 2].map(|channel| mean(&self.colors, channel).round() as u8)
    }
}

fn mean(colors: &[ColorCount], channel: usize) -> f64 {
    let sum: f64 = colors.iter().map(weight).sum();
    colors.iter().map(|c| weight(c) * f64::from(c.0[channel])).sum::<f64>() / sum
}

/// 0 of a single colour, whatever rounding says.
fn spread(colors: &[ColorCount], channel: usize) -> f64 {
    let mean = mean(colors, channel);
    let squares = colors.iter().map(|c| weight(c) * (f64::from(c.0[channel]) - mean).powi(2));
    if colors.len() < 2 { 0.0 } else { squares.sum() }
}
