"""brume/_abi.py says what brume.h says."""
import ctypes
import os
import re
import subprocess

import pytest

from brume import _abi, _library


@pytest.fixture(scope="module")
def header(source):
    with open(os.path.join(source, "sdk/include/brume/brume.h"), encoding="utf-8") as file:
        text = file.read()
    return re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)


@pytest.fixture(scope="module")
def members(header):
    """Names of the members, in order, by struct."""
    found = {}
    for body, name in re.findall(r"typedef struct \w+ \{(.*?)\} (\w+);", header, flags=re.DOTALL):
        found[name] = re.findall(r"(\w+)(?:\[\d+\])?\s*;", body)
    return found


@pytest.fixture(scope="module")
def constants(header):
    names = re.findall(r"^#define BRUME_(\w+)[ \t]+\S", header, flags=re.MULTILINE)
    return [name for name in names if not re.search(r"_INIT$|^VERSION_|^API$", name)]


@pytest.fixture(scope="module")
def compiled(members, constants, source, tmp_path_factory):
    """What a C compiler makes of the header: lines of a name and numbers."""
    lines = ["#include <stdio.h>", "#include <brume/brume.h>", "int main(void)", "{"]
    for struct, fields in members.items():
        lines.append(f'printf("{struct} %zu\\n", sizeof({struct}));')
        for field in fields:
            lines.append(f'printf("{struct}.{field} %zu %zu\\n", offsetof({struct}, {field}), sizeof((({struct} *)0)->{field}));')
    lines += [f'printf("{name} %lld\\n", (long long)BRUME_{name});' for name in constants]
    folder = tmp_path_factory.mktemp("abi")
    (folder / "abi.c").write_text("\n".join(lines + ["return 0;", "}", ""]))
    subprocess.run([os.environ.get("CC", "cc"), "-std=c99", "-Wall", "-Werror", "-I", os.path.join(source, "sdk/include"),
                    "-o", folder / "abi", folder / "abi.c"], check=True)
    said = subprocess.run([folder / "abi"], check=True, capture_output=True, text=True).stdout
    return {line.split()[0]: tuple(map(int, line.split()[1:])) for line in said.splitlines()}


def test_every_struct_is_there(members):
    assert len(members) > 10
    assert [struct.__name__ for struct in _abi.STRUCTS] == list(members)


def test_structs_are_laid_out_alike(members, compiled):
    for struct in _abi.STRUCTS:
        assert (ctypes.sizeof(struct),) == compiled[struct.__name__], struct.__name__
        assert [name for name, _ in struct._fields_] == members[struct.__name__], struct.__name__
        for name, _ in struct._fields_:
            field = getattr(struct, name)
            assert (field.offset, field.size) == compiled[f"{struct.__name__}.{name}"], f"{struct.__name__}.{name}"


def test_members_have_the_kinds_of_the_header(header):
    kinds = {"uint32_t": ctypes.c_uint32, "int32_t": ctypes.c_int32, "uint64_t": ctypes.c_uint64,
             "int64_t": ctypes.c_int64, "double": ctypes.c_double}
    for struct in _abi.STRUCTS:
        body = re.search(r"typedef struct %s \{(.*?)\} %s;" % (struct.__name__, struct.__name__), header, re.DOTALL).group(1)
        for name, kind in struct._fields_:
            declared = re.search(r"([\w ]+?[ *]+)%s(?:\[(\d+)\])?\s*;" % name, body)
            base, count = declared.group(1).replace("const", "").strip(), declared.group(2)
            if base in kinds:
                expected = kinds[base] * int(count) if count else kinds[base]
                assert kind is expected, f"{struct.__name__}.{name}"
            elif base.endswith("_callback"):
                assert issubclass(kind, ctypes._CFuncPtr), f"{struct.__name__}.{name}"
            else:
                assert base.endswith("*") and ctypes.sizeof(kind) == 8, f"{struct.__name__}.{name}: {base}"
                if base == "char *":
                    assert kind is ctypes.c_char_p, f"{struct.__name__}.{name}"


def test_every_constant_has_its_value(constants, compiled):
    assert len(constants) > 40
    for name in constants:
        assert (getattr(_abi, name),) == compiled[name], name


def test_every_function_is_bound_with_as_many_arguments(header):
    declared = {}
    for name, arguments in re.findall(r"BRUME_API [^;]*?(brume_\w+)\(([^)]*)\);", header):
        declared[name] = 0 if arguments.strip() == "void" else arguments.count(",") + 1
    assert len(declared) > 40
    assert {name: len(of) - 1 for name, of in _abi.FUNCTIONS.items()} == declared


def test_defaults_are_those_of_the_library():
    for struct in _abi.STRUCTS:
        assert _library.new(struct).struct_size == ctypes.sizeof(struct)
    assert _library.new(_abi.brume_image).channels == 4
    assert _library.new(_abi.brume_format).far_distance == 1e9


def test_every_status_has_a_class():
    from brume import errors
    for name, value in vars(_abi).items():
        if name.startswith("ERROR_"):
            error = errors.of_status(value, "text")
            assert type(error) is not errors.Error and error.status == value, name
    assert type(errors.of_status(99, "text")) is errors.Error
