//! Animations: APNG, without loss, and GIF, in 256 colours, for programs that know no other.
//!
//! All images have one size and are shown for one time each, over and over. [`Apng`] and [`Gif`]
//! take them one by one, so that no two have to be held at a time; what does not change from one to
//! the next is left out of the file. A GIF has one palette, so that nothing flickers: the
//! [`ColorCounts`] of all its images are counted before the first one is written.

mod apng;
mod gif;
mod palette;
mod pixel_box;

pub use apng::Apng;
pub use gif::Gif;
pub use palette::ColorCounts;
pub use pixel_box::AnimationError;

#[cfg(test)]
mod tests {
    use ppum_testkit::random::Random;

    use super::*;
    use crate::colormap::Colormap;
    use crate::image::Image;
    use crate::png::TextChunk;

    fn apng(
        images: &[Image],
        milliseconds: u16,
        texts: &[TextChunk],
    ) -> Result<Vec<u8>, AnimationError> {
        let size = images.first().ok_or(AnimationError::Empty)?.size;
        let mut bytes = Vec::new();
        let count = u32::try_from(images.len()).unwrap_or(u32::MAX);
        let mut file = Apng::new(&mut bytes, size, count, milliseconds, texts)?;
        images.iter().try_for_each(|image| file.add(image))?;
        file.finish()?;
        Ok(bytes)
    }

    fn gif(images: &[Image], milliseconds: u16) -> Result<Vec<u8>, AnimationError> {
        let size = images.first().ok_or(AnimationError::Empty)?.size;
        let mut colors = ColorCounts::new();
        images.iter().for_each(|image| colors.add(image));
        let mut bytes = Vec::new();
        let mut file = Gif::new(&mut bytes, size, &colors, milliseconds)?;
        images.iter().try_for_each(|image| file.add(image))?;
        file.finish()?;
        Ok(bytes)
    }

    /// A slope whose colours move, with a corner that is not there.
    fn images(map: &str, count: u32) -> Vec<Image> {
        let colors = Colormap::named(map).unwrap().palette(64);
        let image = |step: u32| {
            let mut image = Image::filled([64, 16], [0; 4]);
            let pixels = image.rgba.as_chunks_mut::<4>().0;
            for (k, pixel) in (0u32..).zip(pixels).skip(5) {
                *pixel = colors[((k + 3 * step) % 64) as usize];
            }
            image
        };
        (0..count).map(image).collect()
    }

    #[test]
    fn apng_is_without_loss() {
        let images = images("viridis", 4);
        let bytes = apng(&images, 40, &[("Title".into(), "Waves".into())]).unwrap();
        let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let control = *reader.info().animation_control().unwrap();
        assert_eq!((control.num_frames, control.num_plays), (4, 0));
        for image in &images {
            let mut data = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut data).unwrap();
            assert_eq!(data, image.rgba);
            let frame = reader.info().frame_control().unwrap();
            assert_eq!((frame.delay_num, frame.delay_den), (40, 1000));
        }
        assert_eq!(reader.info().uncompressed_latin1_text[0].text, "Waves");
    }

    fn read(bytes: &[u8]) -> Vec<(u16, Vec<u8>)> {
        let mut options = ::gif::DecodeOptions::new();
        options.set_color_output(::gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            frames.push((frame.delay, frame.buffer.to_vec()));
        }
        frames
    }

    #[test]
    fn gif_keeps_few_colours_as_they_are() {
        let images = images("viridis", 3);
        let frames = read(&gif(&images, 44).unwrap());
        assert_eq!(frames.len(), 3);
        for ((delay, found), image) in frames.iter().zip(&images) {
            assert_eq!(*delay, 4);
            let pairs = found.as_chunks::<4>().0.iter().zip(image.rgba.as_chunks::<4>().0);
            assert!(pairs.clone().all(|(a, b)| a == b || (a[3] == 0 && b[3] == 0)));
        }
    }

    /// A thousand colours in 255: as the maps are lines through the cube of colours, none is
    /// far off.
    #[test]
    fn gif_takes_many_colours_to_near_ones() {
        let mut image = Image::filled([1024, 3], [0; 4]);
        let maps = ["viridis", "turbo", "twilight"].map(|name| Colormap::named(name).unwrap());
        let colors = maps.iter().flat_map(|map| map.palette(1024));
        image.rgba = colors.flatten().collect();
        let (_, found) = read(&gif(&[image.clone()], 100).unwrap()).remove(0);
        let worst = found.iter().zip(&image.rgba).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(worst < Some(12), "{worst:?}");
    }

    /// Opaque images of which now little changes, now nothing, now all; with holes if that is
    /// asked for.
    fn wandering(with_holes: bool) -> Vec<Image> {
        let mut random = Random(5);
        let mut image = Image::filled([40, 30], [20, 30, 40, 255]);
        let mut all = vec![image.clone()];
        for kind in [1, 0, 2, 1, 1, 2, 0, 1] {
            let count = [0, 7, 3000][kind];
            for _ in 0..count {
                let at = random.below(1200);
                let level = [0, 90, 180, 255][random.below(4)];
                let opacity = if with_holes { random.pick(&[0, 255]) } else { 255 };
                image.rgba[4 * at..4 * at + 4].copy_from_slice(&[level, 60, 255 - level, opacity]);
            }
            all.push(image.clone());
        }
        all
    }

    /// Same colours, or both transparent.
    fn look_alike(a: &[u8], b: &[u8]) -> bool {
        let pairs = a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0);
        pairs.into_iter().all(|(a, b)| a == b || (a[3] == 0 && b[3] == 0))
    }

    /// Puts the pixels of a box of an animation's frame on a canvas, if `is_put` says so of them.
    fn put(
        canvas: &mut [u8],
        [left, top, width]: [usize; 3],
        data: &[u8],
        is_put: impl Fn([u8; 4]) -> bool,
    ) {
        for (k, pixel) in data.as_chunks::<4>().0.iter().enumerate().filter(|(_, p)| is_put(**p)) {
            let at = 4 * ((top + k / width) * 40 + left + k % width);
            canvas[at..at + 4].copy_from_slice(pixel);
        }
    }

    /// Pixels that do not change are left out of the file, and a program shows the original images.
    #[test]
    fn only_what_changes_is_stored() {
        for with_holes in [false, true] {
            let images = wandering(with_holes);
            let bytes = gif(&images, 100).unwrap();
            let mut options = ::gif::DecodeOptions::new();
            options.set_color_output(::gif::ColorOutput::RGBA);
            let mut decoder = options.read_info(&bytes[..]).unwrap();
            let (mut canvas, mut stored) = (vec![0; 4800], 0);
            for image in &images {
                let frame = decoder.read_next_frame().unwrap().unwrap();
                let place = [frame.left, frame.top, frame.width].map(usize::from);
                put(&mut canvas, place, &frame.buffer, |pixel| pixel[3] > 0);
                stored += frame.buffer.len();
                assert!(look_alike(&canvas, &image.rgba));
                if frame.dispose == ::gif::DisposalMethod::Background {
                    canvas.fill(0);
                }
            }
            assert!(decoder.read_next_frame().unwrap().is_none());
            assert_eq!(stored < 4800 * images.len(), !with_holes);

            let bytes = apng(&images, 100, &[]).unwrap();
            let mut reader = ::png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
            let (mut canvas, mut stored) = (vec![0; 4800], 0);
            for image in &images {
                let mut data = vec![0; 4800];
                let size = reader.next_frame(&mut data).unwrap().buffer_size();
                let frame = reader.info().frame_control().unwrap();
                let place = [frame.x_offset, frame.y_offset, frame.width].map(|n| n as usize);
                assert_eq!(frame.blend_op, ::png::BlendOp::Source);
                put(&mut canvas, place, &data[..size], |_| true);
                stored += size;
                assert_eq!(canvas, image.rgba);
            }
            assert!(stored < 4800 * images.len());
        }
    }

    #[test]
    fn colours_that_were_not_counted_are_near_ones() {
        let images = wandering(false);
        let mut colors = ColorCounts::new();
        colors.add(&images[0]);
        let mut bytes = Vec::new();
        let mut file = Gif::new(&mut bytes, [40, 30], &colors, 20).unwrap();
        file.add(&images[4]).unwrap();
        file.finish().unwrap();
        let (delay, pixels) = read(&bytes).remove(0);
        assert!(delay == 2 && look_alike(&pixels, &images[0].rgba));
    }

    #[test]
    fn the_announced_number_of_images() {
        let images = images("magma", 3);
        let count = 2;
        let mut file = Apng::new(Vec::new(), images[0].size, count, 40, &[]).unwrap();
        file.add(&images[0]).unwrap();
        file.add(&images[1]).unwrap();
        let more = file.add(&images[2]).unwrap_err();
        assert!(matches!(more, AnimationError::Count { announced: 2, found: 3 }), "{more}");
        file.finish().unwrap();
        let mut file = Apng::new(Vec::new(), images[0].size, count, 40, &[]).unwrap();
        file.add(&images[0]).unwrap();
        assert!(matches!(file.finish(), Err(AnimationError::Count { announced: 2, found: 1 })));
        let none = Gif::new(Vec::new(), [4, 4], &ColorCounts::new(), 40).unwrap().finish();
        assert!(matches!(none, Err(AnimationError::Empty)));
    }

    #[test]
    fn what_moves_has_one_size() {
        let mut all = images("magma", 2);
        all.push(Image::filled([3, 3], [0; 4]));
        for error in [apng(&all, 10, &[]).unwrap_err(), gif(&all, 10).unwrap_err()] {
            assert!(matches!(error, AnimationError::Sizes { index: 2, size: [3, 3], .. }));
        }
        assert!(matches!(gif(&[], 10), Err(AnimationError::Empty)));
        let long = Image::filled([65536, 1], [0; 4]);
        assert!(matches!(gif(&[long], 10), Err(AnimationError::TooLarge { .. })));
    }
}
