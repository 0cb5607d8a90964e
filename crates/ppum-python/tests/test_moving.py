"""Moving pictures of series, against the program's files and against figures of the single steps."""

import io

import numpy as np
import ppum
import pytest

Image = pytest.importorskip("PIL.Image")
ImageSequence = pytest.importorskip("PIL.ImageSequence")


def frames(data):
    image = Image.open(io.BytesIO(data))
    shown = [np.array(frame.convert("RGBA")) for frame in ImageSequence.Iterator(image)]
    return shown, image.info["duration"]


@pytest.mark.parametrize(
    "options, wanted",
    [
        (["-q", "uy", "--figure"], {"quantity": "uy"}),
        (["-q", "von-mises", "--figure", "--size", "400x300", "--fps", "16"], {"size": (400, 300), "fps": 16}),
        (["-q", "uy", "--figure", "--deformed", "auto", "--outline"], {"quantity": "uy", "deformed": "auto", "outline": True}),
        (["-q", "s1", "--figure", "--range", "0,3", "--steps", "0..2:2"], {"quantity": "s1", "clim": (0.0, 3.0), "steps": [0, 2]}),
        (["-q", "level", "--figure"], {"quantity": "level"}),
        (["-q", "syy", "--figure", "--part", "tip", "--steps", "1,2"], {"quantity": "syy", "steps": slice(1, None)}),
        (["-q", "uy", "--view", "0.2,0.3,0.8,0.7", "--size", "300x200"], {"quantity": "uy", "bare": True, "center": (0.5, 0.5), "width": 0.6, "size": (300, 200)}),
    ],
)
def test_pictures_are_those_of_the_program(grown, program, tmp_path, options, wanted):
    """A GIF to the last byte; an APNG has texts besides."""
    grown.save(tmp_path / "grown.h5")
    field = grown.field.part("tip") if "--part" in options else grown.field
    steps = [] if "--steps" in options else ["--steps", "all"]
    moving = field.draw.animate(**wanted)
    for form in ("gif", "apng"):
        program("render", tmp_path / "grown.h5", "-o", tmp_path / f"theirs.{form}", *options, *steps)
        moving.save(tmp_path / f"ours.{form}")
    assert (tmp_path / "ours.gif").read_bytes() == (tmp_path / "theirs.gif").read_bytes()
    (ours, time), (theirs, its_time) = (frames((tmp_path / f"{name}.apng").read_bytes()) for name in ("ours", "theirs"))
    assert len(ours) == len(theirs) > 1 and time == its_time
    assert all(np.array_equal(a, b) for a, b in zip(ours, theirs, strict=True))


def test_steps_have_one_range_and_their_numbers(grown):
    """With the range given, each is the figure of its step."""
    shown, time = frames(grown.field.draw.animate("uy", clim=(-3.0, 3.0), size=(360, 280), fps=4).apng())
    assert time == 250 and len(shown) == len(grown.steps)
    for step, image in zip(grown.steps, shown, strict=True):
        figure = step.field.draw.figure("uy", clim=(-3.0, 3.0), size=(360, 280))
        assert f"Grown, step {step.number}" in figure.svg()
        alone = np.array(Image.open(io.BytesIO(figure.png())).convert("RGBA"))
        # bars of a series show what lies beyond them in any of its steps
        assert (alone != image).any(axis=-1).mean() < 0.01
    assert len({image.tobytes() for image in shown}) == len(shown)


def test_what_is_no_moving_picture_is_refused(grown, f, tmp_path):
    for wrong, error, message in [
        ({"steps": [3]}, IndexError, "there is no step 3: there are 3 steps"),
        ({"steps": []}, ValueError, "needs one step"),
        ({"fps": 0}, ValueError, "from 1/60 to 50"),
        ({"speed": 3}, TypeError, "animate.. has no option `speed`"),
    ]:
        with pytest.raises(error, match=message):
            grown.field.draw.animate(**wrong)
    with pytest.raises(ppum.RenderError, match="do not fit into memory"):
        grown.field.draw.animate(size=(20000, 20000)).gif()
    with pytest.raises(ppum.QuantityError, match="nonsense"):
        grown.field.draw.animate("nonsense").gif()
    moving = grown.field.draw.animate("uy", size=(320, 200), steps=[0, -1])
    with pytest.raises(ValueError, match="forms of Animation are gif, apng"):
        moving.save(tmp_path / "grown.mp4")
    assert repr(moving) == "<ppum.Animation of uy, 2 steps, 320x200>" and not list(tmp_path.iterdir())
    assert moving._repr_png_()[:4] == b"\x89PNG" and len(frames(f.draw.animate(size=(320, 300)).gif())[0]) == 1
