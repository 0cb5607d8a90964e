"""Numbers of all forms in, values of the right shape out; a value depends on its point alone."""

import ast

import numpy as np
import ppum
import pytest


def points(seed, n, domain=((-1, -2), (1, 2))):
    random = np.random.default_rng(seed)
    low, high = np.array(domain, float)
    return random.uniform(low, high, (n, 2)).T.copy()


def same(a, b):
    assert np.asarray(a).dtype == np.asarray(b).dtype == np.float64
    assert np.asarray(a).shape == np.asarray(b).shape
    assert np.array_equal(np.asarray(a).view(np.uint64), np.asarray(b).view(np.uint64))


FORMS = {
    "fortran": np.asfortranarray,
    "big-endian": lambda a: a.astype(">f8"),
    "strided": lambda a: np.repeat(a, 3, axis=-1)[..., ::3],
    "reversed": lambda a: a[::-1].copy()[::-1],
    "transposed": lambda a: a.T.copy().T,
    "list": lambda a: a.tolist(),
    "tuple": lambda a: tuple(map(tuple, a.tolist())),
    "masked": lambda a: np.ma.array(a),
    "read-only": lambda a: np.lib.stride_tricks.as_strided(a, writeable=False),
    "longdouble": lambda a: a.astype(np.longdouble),
    "matrix rows": lambda a: np.asarray(np.asmatrix(a)),
}


@pytest.mark.filterwarnings("ignore:the matrix subclass")
@pytest.mark.parametrize("form", FORMS)
def test_every_form_of_array(f, form):
    x, y = points(1, 60).reshape(2, 6, 10)
    expected = f.at(x, y).von_mises
    same(f.at(FORMS[form](x), FORMS[form](y)).von_mises, expected)
    same(f.at(FORMS[form](x), y).von_mises, expected)
    found = f.evaluate(FORMS[form](x), y, ["ux", "von_mises"])
    assert found.shape == (6, 10, 2)
    same(np.ascontiguousarray(found[..., 1]), expected)


@pytest.mark.parametrize("kind", [np.float32, np.float16, np.int8, np.int64, np.uint16, bool])
def test_other_numbers(f, kind):
    x = np.array([0, 1, 0, 1], kind)
    same(f.at(x, x).uy, f.at(x.astype(float), x.astype(float)).uy)


@pytest.mark.parametrize("wrong", [1j, [1j], ["a"], [None], np.array(["2020"], "M8[D]"), {}, object()])
def test_what_is_no_number(f, wrong):
    with pytest.raises(TypeError):
        f.at(wrong, 0.0).ux  # noqa: B018


def test_broadcasting(f):
    x, y = np.linspace(-1, 1, 7), np.linspace(-2, 2, 5)[:, None]
    assert f.at(x, y).s1.shape == (5, 7)
    same(f.at(x, y).s1, f.at(*np.broadcast_arrays(x, y)).s1)
    same(f.at(x, 0.5).s1, f.at(x, np.full(7, 0.5)).s1)
    with pytest.raises(ValueError, match="broadcast"):
        f.at(np.zeros(3), np.zeros(4))


@pytest.mark.parametrize("shape", [(), (0,), (1,), (3, 0), (2, 1, 3), (1, 1, 1, 2)])
def test_shapes(f, shape):
    x = np.full(shape, 0.3)
    v = f.at(x, 0.2)
    assert v.ux.shape == shape and v["ux + uy"].shape == shape
    assert v.gradient("von_mises").shape == (*shape, 2)
    assert f.at(x, 0.2, side="both").ux.shape == (*shape, 2)
    assert f.at(x, 0.2, side="both").gradient("ux").shape == (*shape, 2, 2)
    assert f.evaluate(x, 0.2, ["ux", "uy", "s1"]).shape == (*shape, 3)
    assert f.evaluate(x, 0.2, []).shape == (*shape, 0)
    assert f.evaluate(x, 0.2, ["ux", "s1"], side="both").shape == (*shape, 2, 2)
    values, slopes = f.evaluate(x, 0.2, ["ux", "uy", "s1"], gradient=True)
    assert values.shape == (*shape, 3) and slopes.shape == (*shape, 3, 2)


def test_one_number(f):
    for x in (0, 0.25, np.float64(0.25), np.float32(0.25), np.int64(0), np.array(0.25), True):
        value = f.at(x, 0.1).von_mises
        assert isinstance(value, np.float64) or value.shape == ()
        assert float(value) == f.at([float(x)], [0.1]).von_mises[0]


@pytest.mark.parametrize("dataset", ["ds", "holed", "potential"])
def test_values_depend_on_their_points_alone(request, dataset):
    field = request.getfixturevalue(dataset).field
    names = [*field.components, field._core.default_quantity(), "overlap", "x + magnitude"]
    x, y = points(2, 5000, field.dataset.domain)
    for tip in field.step.tips:
        near = 10.0 ** -np.arange(16)
        x, y = np.append(x, tip.xy[0] + near), np.append(y, tip.xy[1] - near)
    together = field.evaluate(x, y, names)
    order = np.random.default_rng(3).permutation(len(x))
    same(field.evaluate(x[order], y[order], names), together[order])
    for k in order[:300]:
        same(field.evaluate(x[k], y[k], names), together[k])
        same(field.evaluate(x[k : k + 9], y[k : k + 9], names), together[k : k + 9])
        single = [field.at(float(x[k]), float(y[k]))[name] for name in names]
        same(np.array(single), together[k])


def test_out(f):
    x, y = points(4, 1000)
    out = np.empty((1000, 2))
    assert f.evaluate(x, y, ["ux", "s1"], out=out) is out
    same(out, f.evaluate(x, y, ["ux", "s1"]))
    for wrong in (np.empty((2, 1000)).T, np.empty((1000, 3)), np.empty((1000, 2), np.float32), [0.0]):
        with pytest.raises(ValueError, match="out"):
            f.evaluate(x, y, ["ux", "s1"], out=wrong)
    with pytest.raises(ValueError, match="memory"):
        f.evaluate(x, y, ["ux"], out=x.reshape(-1, 1))
    out.flags.writeable = False
    with pytest.raises(ValueError, match="writeable"):
        f.evaluate(x, y, ["ux", "s1"], out=out)


def test_nothing_is_copied(f):
    x, y = points(5, 1000)
    v = f.at(x, y)
    assert np.shares_memory(v._x, x) and np.shares_memory(v._y, y)
    assert v.ux.base is None or v.ux.flags.owndata or v.ux.base.size == 1000


def test_outside_and_undefined(f):
    x = np.array([5.0, np.nan, np.inf, -np.inf, 1e308, 0.0])
    assert np.isnan(f.at(x, 0.1).ux).tolist() == [True] * 5 + [False]
    masked = np.ma.array([0.0, 0.5], mask=[False, True])
    assert np.isnan(f.at(masked, 0.1).ux).tolist() == [False, True]
    # corners and borders are of the plate
    assert np.isfinite(f.at([-1, 1, -1, 1], [-2, -2, 2, 2]).sxx).all()


def test_names(f):
    v = f.at(0.4, 0.3)
    assert v.von_mises == v["von-mises"] == v["von_mises"]
    assert v["sxx + syy"] == pytest.approx(v.sxx + v.syy, rel=1e-14)
    assert {"ux", "von_mises", "s1", "gradient"} <= set(dir(v))
    assert not hasattr(v, "no_such_quantity")
    with pytest.raises(AttributeError, match="von-mises"):
        v.von_misse  # noqa: B018
    with pytest.raises(ppum.QuantityError):
        v["ux +"]  # noqa: B018
    with pytest.raises(TypeError, match="list"):
        f.evaluate(0, 0, "ux")
    assert f.quantities["von_mises"].symbol == "von Mises stress"
    assert "von-mises" in f.quantities and len(f.quantities) > 20


def test_repr_is_one_line(ds, f):
    for thing in (ds, ds.steps[0], f, f.at(0, 0), ds.tips[0], ds.cracks[0], f.draw.figure(), ds.history, f.quantities):
        text = repr(thing)
        assert "\n" not in text and text.startswith("<ppum"), text
    assert ast.literal_eval(repr(ds.title)) in repr(ds)
