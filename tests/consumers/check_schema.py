"""Validates recipes against the JSON Schema of recipes, and sees that the schema refuses what is wrong.

    pip install jsonschema pyyaml
    python tests/consumers/check_schema.py templates/recipe.schema.json recipes/*.yaml

Exits with 1 and a list of what is wrong if there is anything.
"""

import argparse
import copy
import json
import sys
from pathlib import Path

import yaml
from jsonschema import Draft7Validator


def set_at(recipe, path, value):
    """The recipe with another value at a path of keys and indices."""
    changed = copy.deepcopy(recipe)
    place = changed
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    return changed


REFUSED = [
    (["watre"], {}),
    (["frames"], "many"),
    (["water"], {"temprature_c": 3}),
    (["water"], {"temperature_c": {"unifrom": [1, 2]}}),
    (["sonar", "range_m"], [1, 2, 3]),
    (["seabed", "shape"], "hills"),
    (["objects", 0, "pick"], {"tag": "tire"}),
    (["trajectory"], {"orbit": {"radius_m": "$1"}}),
    (["splits"], {"by": "moon"}),
    (["sweep"], {"gird": {}}),
]
ACCEPTED = [
    (["let"], {"depth": {"uniform": [2, 10]}}),
    (["water"], {"depth_m": "$depth", "ph": {"normal": [8, 0.1], "min": 7, "per": "frame"}}),
    (["seabed", "shape"], {"choice": {"flat": 1, "ripples": 2}}),
    (["trajectory"], {"orbit": {"radius_m": "$r", "altitude_m": {"int": [1, 3]}, "look_at": [0, 0, "$z"]}}),
    (["sweep"], {"grid": {"sonar.device": ["a", "b"]}, "count": 2}),
    (["splits"], {"by": "asset"}),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("schema", type=Path)
    parser.add_argument("recipes", type=Path, nargs="+")
    arguments = parser.parse_args()
    schema = json.loads(arguments.schema.read_text())
    Draft7Validator.check_schema(schema)
    validator = Draft7Validator(schema)
    wrong = []
    for path in arguments.recipes:
        text = path.read_text()
        recipe = yaml.safe_load(text)
        wrong += [f"{path}: {error.json_path}: {error.message}" for error in validator.iter_errors(recipe)]
        first = text.splitlines()[0]
        marker = "# yaml-language-server: $schema="
        if not first.startswith(marker) or not (path.parent / first.removeprefix(marker)).is_file():
            wrong.append(f"{path}: the first line names no schema")
        if not isinstance(recipe.get("seabed"), dict) or not recipe.get("objects"):
            continue
        wrong += [f"{path}: {where} = {value} is accepted" for where, value in REFUSED
                  if validator.is_valid(set_at(recipe, where, value))]
        wrong += [f"{path}: {where} = {value} is refused" for where, value in ACCEPTED
                  if not validator.is_valid(set_at(recipe, where, value))]
    print("\n".join(wrong) or f"{len(arguments.recipes)} recipes are as the schema says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
