"""The JSON Schema of a scene, judged by another program: it takes every good scene and refuses what a schema can see."""

import re
from pathlib import Path

import creepage
import pytest

jsonschema = pytest.importorskip("jsonschema")
tomllib = pytest.importorskip("tomllib")

ROOT = Path(__file__).parents[2]
# Tables of axles and expected errors have other forms.
SCENES = [*ROOT.glob("examples/scenes/*.toml"), *ROOT.glob("tests/data/difficult/*.toml")]


@pytest.fixture(scope="module")
def validator():
    schema = creepage.schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def mistakes():
    """The scenes of the tables of mistakes: name, text, and the exit status of ``creepage check``."""
    read = lambda path: (ROOT / "tests" / path).read_text(encoding="utf-8")
    full = re.search(r'const FULL: &str = r#"(.*?)"#;', read("scene/mod.rs"), re.S).group(1)
    for scene, rows in [
        (read("messages/scene.toml"), read("messages/scenes.txt")),
        (full, read("messages/full_scenes.txt")),
    ]:
        for row in filter(None, rows.splitlines()):
            if not row.startswith("## "):
                old, row = row.split(" → ", 1)
                new, status, *_ = row.split(" | ")
                plain = lambda text: text.replace("¶", "\n").replace("⇥", "\t").replace("∅", "")
                yield row, scene.replace(plain(old), plain(new), 1), int(status)


def test_good_scenes_are_valid(validator):
    assert len(SCENES) >= 10
    for path in SCENES:
        errors = list(validator.iter_errors(tomllib.loads(path.read_text(encoding="utf-8"))))
        assert not errors, f"{path}: {errors[0].message} at {list(errors[0].absolute_path)}"


def test_mistakes_that_a_schema_can_see_are_refused(validator):
    refused = missed = 0
    for name, text, status in mistakes():
        try:
            scene = tomllib.loads(text)
        except tomllib.TOMLDecodeError:
            continue
        if status == 0:
            # What is only hardly meant is valid.
            assert validator.is_valid(scene), name
        elif validator.is_valid(scene):
            missed += 1
        else:
            refused += 1
    # What it cannot see are values that contradict each other, and numbers that follow from others.
    assert refused >= 135 and missed <= 40, (refused, missed)


def test_a_preset_may_give_what_is_required(validator):
    scene = tomllib.loads((ROOT / "examples/scenes/full-scale-upper.toml").read_text(encoding="utf-8"))
    scene["vehicles"] = [{"preset": "t-25"}]
    assert validator.is_valid(scene)
    scene["vehicles"] = [{"preset": "t-26"}]
    assert not validator.is_valid(scene)
