"""The names that the package offers, and old ones, which warn for one version and say the new one."""

import operator
import pickle
import warnings

import ppum
import pytest
from ppum._warnings import NAMES


def test_few_names_are_offered():
    assert len(ppum.__all__) <= 36
    assert not set(NAMES["ppum"]) & {*ppum.__all__, *vars(ppum)}


@pytest.mark.parametrize("owner, name", [(owner, name) for owner, names in NAMES.items() for name in names])
def test_old_names_work_and_say_the_new_one(owner, name, f):
    thing = {"ppum": ppum, "Field": f, "ProblemError": ppum.ProblemError("no", [])}[owner]
    new = NAMES[owner][name]
    with pytest.warns(DeprecationWarning, match=f"^{owner}.{name} is now {owner}.{new};") as caught:
        old = getattr(thing, name)
    now = operator.attrgetter(new)(thing)
    # methods of accessors are bound anew
    assert getattr(old, "__func__", old) == getattr(now, "__func__", now) and caught[0].filename == __file__
    assert name not in dir(thing)


def test_the_function_that_was_called_build_works():
    cover = ppum.build.Cover.uniform([(0, 0), (1, 1)], (1, 1))
    state = ppum.build.State(cover, ppum.build.Coefficients("u", {"one": [[1.0]]}))
    with pytest.warns(DeprecationWarning, match=r"^ppum\.build\(…\) is now ppum\.build\.dataset"):
        assert ppum.build(state, title="one") == ppum.build.dataset(state, title="one")


def test_new_names_do_not_warn(f):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        f.sample.line((0, 0), (1, 1), num=3), f.draw.render("ux", size=(2, 2)), f.compare(f, size=(2, 2)), f.export.triangles
        assert ppum.Field.draw.figure and ppum.Field.sample.__doc__
        assert pickle.loads(pickle.dumps(f)) == f and pickle.loads(pickle.dumps(f.step.tips)) == f.step.tips


def test_names_that_never_were_are_refused(f):
    with pytest.raises(AttributeError, match="ppum has no attribute 'Fild'"):
        ppum.Fild
    with pytest.raises(AttributeError):
        f.lines
