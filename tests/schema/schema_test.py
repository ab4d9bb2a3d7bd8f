"""schema_test.py LIBRARY SOURCES: the schema and the parser take the same scenes, and the documentation's table has all keys.

Scenes of the documentation and the samples, random ones made from the schema, and mutations of both. What the schema cannot say
(UNSAID) the parser may refuse beside it; nothing may be the other way round.
"""
import copy
import ctypes
import json
import math
import pathlib
import random
import re
import sys
import tempfile

from jsonschema import Draft202012Validator

RANDOM_SCENES = 1500
MUTATIONS = 3  # of each scene
UNSAID = (
    "expected a frame after",
    "expected a rigid motion",
    "expected a vector that is not zero",  # all of whose keys are zero
    "expected no group, since surfaces is false",
    "expected a group of its own",
    "expected a number above near",
    "cannot be read",
    "expected .csv or .ply",
)
NONSENSE = (None, True, False, "", "1", "constant", [], {}, [1, 2], [[1]], -1, -0.0, 0, 0.5, 1, 2, 1e31, -1e31, 1e-320, 181, 65536)


class Library:
    def __init__(self, path):
        self.library = ctypes.CDLL(path)
        for name in ("brume_scene_schema", "brume_message"):
            getattr(self.library, name).restype = ctypes.c_size_t
        self.context = ctypes.c_void_p()
        if self.library.brume_context_create(None, ctypes.byref(self.context)):
            sys.exit("no context")

    def text(self, function, *capacity):
        buffer = ctypes.create_string_buffer(1 << 20)
        function(self.context, buffer, ctypes.c_size_t(len(buffer)))
        return buffer.value.decode()

    def schema(self):
        return json.loads(self.text(self.library.brume_scene_schema))

    def refusal(self, scene, name):
        """The parser's message; None: it takes the scene."""
        text, handle = json.dumps(scene).encode(), ctypes.c_void_p()
        status = self.library.brume_scene_create_from_text(self.context, text, ctypes.c_size_t(len(text)), name.encode(),
                                                           ctypes.byref(handle))
        if status:
            return self.text(self.library.brume_message)
        self.library.brume_scene_destroy(handle)
        return None


class Maker:
    """Random instances of a schema."""

    def __init__(self, dice, file):
        self.dice, self.file = dice, file

    def number(self, schema, whole):
        low = schema.get("minimum", schema.get("exclusiveMinimum"))
        high = schema.get("maximum", schema.get("exclusiveMaximum"))
        if whole:
            return self.dice.randint(int(low), int(high))
        if self.dice.random() < 0.2 and "minimum" in schema:
            return self.dice.choice((low, high))
        return min(max(self.dice.choice((-1, 1)) * 10 ** self.dice.uniform(-3, 3), low + (high - low) * 1e-12), high * 0.999)

    def keys(self, schema):
        value = schema["items"]["prefixItems"][1]
        frames = sorted(self.dice.sample(range(-20, 200), self.dice.randint(1, 3)))
        return [[frame, self.make(value)] for frame in frames]

    def pose(self):
        turn = self.dice.uniform(0, 7)
        return [[math.cos(turn), 0, math.sin(turn), 3], [0, 1, 0, -2], [-math.sin(turn), 0, math.cos(turn), 1], [0, 0, 0, 1]]

    def object(self, schema):
        properties, required = schema["properties"], list(schema.get("required", []))
        excluded = [set(rule["not"]["required"]) for rule in schema.get("allOf", [])]
        keys = required + [key for key in properties if key not in required and self.dice.random() < 0.4]
        for pair in excluded:
            if pair <= set(keys):
                keys.remove(self.dice.choice(sorted(pair)))
        self.dice.shuffle(keys)
        return {key: self.member(key, properties[key]) for key in keys}

    def member(self, key, schema):
        return {"keys": lambda: self.keys(schema), "camera_to_world": self.pose, "file": lambda: self.file}.get(
            key, lambda: self.make(schema))()

    def make(self, schema):
        for choice in ("anyOf", "oneOf"):
            if choice in schema:
                return self.make(self.dice.choice(schema[choice]))
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return self.dice.choice(schema["enum"])
        kind = schema["type"]
        if kind == "object":
            return self.object(schema)
        if kind == "array":
            least = schema.get("minItems", 0)
            return [self.make(schema["items"]) for _ in range(self.dice.randint(least, min(schema.get("maxItems", 3), least + 3)))]
        if kind == "boolean":
            return self.dice.random() < 0.5
        if kind == "string":
            return self.dice.choice(("L0", "key light"))
        return self.number(schema, kind == "integer")


def places(value):
    """Every container in it."""
    if isinstance(value, (dict, list)):
        yield value
        for child in value.values() if isinstance(value, dict) else value:
            yield from places(child)


def mutated(scene, names, dice):
    scene = copy.deepcopy(scene)
    place = dice.choice(list(places(scene)))
    keys = list(place) if isinstance(place, dict) else list(range(len(place)))
    what = dice.randrange(5)
    if what == 0 and isinstance(place, dict):
        place[dice.choice(names)] = dice.choice(NONSENSE)
    elif what == 1 and keys:
        del place[dice.choice(keys)]
    elif what == 2 and isinstance(place, list) and place:
        place.insert(0, copy.deepcopy(dice.choice(place)))
    elif what == 3 and keys and isinstance(number := place[key := dice.choice(keys)], (int, float)) and not isinstance(number, bool):
        place[key] = number * dice.choice((-1, 1e3, 1e40, 1e-40)) + dice.choice((0, 0.25, 1))
    elif keys:
        place[dice.choice(keys)] = dice.choice(NONSENSE)
    return scene


def known_names(schema):
    found = {"fog"}
    for place in places(schema):
        if isinstance(place, dict) and isinstance(place.get("properties"), dict):
            found.update(place["properties"])
    return sorted(found)


def written(sources):
    """Scenes that people wrote: whole files, and blocks of the documentation."""
    for file in sorted(sources.glob("samples/**/*.json")):
        yield json.loads(file.read_text())
    for page in sorted([*sources.glob("*.md"), *sources.glob("docs/*.md"), *sources.glob("samples/*/*.md")]):
        for block in re.findall(r"^```json\n(.*?)^```", page.read_text(), re.M | re.S):
            yield json.loads(block)


def told(page):
    """Keys of the table of a page, each with what its default is said to be."""
    return {key: default.strip() for key, default in re.findall(r"^\| `([a-z_.\[\]]+)` \|(.*?)\|", page.read_text(), re.M)}


def untold(schema, keys):
    """What the page's table has not, or has otherwise, of the schema's fields. Defaults in words are left."""
    for block, path in (("camera", "camera"), ("medium", "medium"), ("environment", "environment"), ("quality", "quality"),
                        ("lights", "lights[]"), ("density", "density[]")):
        one = schema["properties"]["medium"]["properties"]["density"] if block == "density" else schema["properties"][block]
        one = one.get("items", one)
        for kind in one.get("oneOf", [one]):
            for key, field in kind.get("properties", {}).items():
                default = keys.get(f"{path}.{key}")
                if default is None:
                    yield f"no row of {path}.{key}"
                elif default == "required" and key not in kind.get("required", []):
                    yield f"{path}.{key} is said to be required"
                elif "default" in field and default and default[0] in "[\"-0123456789" and json.loads(default) != field["default"]:
                    yield f"{path}.{key}: the default is said to be {default}, and is {field['default']}"


def main(library, sources):
    brume = Library(library)
    schema = brume.schema()
    Draft202012Validator.check_schema(schema)
    validator, names, dice = Draft202012Validator(schema), known_names(schema), random.Random(7)
    counts, faults = {(taken, valid): 0 for taken in (True, False) for valid in (True, False)}, []

    faults += untold(schema, told(sources / "docs" / "sequences.md"))
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "puffs.csv").write_text("x,y,z,scale,amplitude\n0,5,1,0.5,0.3\n")
        maker = Maker(dice, "puffs.csv")

        def hold(scene, unsaid):
            refusal = brume.refusal(scene, folder + "/scene.json")
            error = next(validator.iter_errors(scene), None)
            counts[refusal is None, error is None] += 1
            if refusal is None and error is not None:
                faults.append(f"the parser takes what the schema refuses: {error.message} at {list(error.path)}\n  {json.dumps(scene)}")
            elif refusal is not None and error is None and not any(said in refusal for said in unsaid):
                faults.append(f"the schema takes what the parser refuses: {refusal}\n  {json.dumps(scene)}")
            return refusal

        scenes = [scene for scene in written(sources) if isinstance(scene, dict) and "brume" in scene]
        wrote = len(scenes)
        scenes += [maker.make(schema) for _ in range(RANDOM_SCENES)]
        for index, scene in enumerate(scenes):
            refusal = hold(scene, UNSAID)
            if refusal is not None and index >= wrote and not any(said in refusal for said in UNSAID):
                faults.append(f"made from the schema, refused: {refusal}\n  {json.dumps(scene)}")
            for _ in range(MUTATIONS):
                hold(mutated(scene, names, dice), UNSAID)

    for (taken, valid), count in counts.items():
        print(f"{count} scenes: parser {'takes' if taken else 'refuses'}, schema {'takes' if valid else 'refuses'}")
    print(*faults[:20], sep="\n")
    if faults:
        sys.exit(f"{len(faults)} differences of schema, parser and table")
    if wrote < 8 or counts[False, False] < RANDOM_SCENES or counts[True, True] < RANDOM_SCENES:
        sys.exit(f"too little was compared; {wrote} scenes of the documentation and the samples")


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
