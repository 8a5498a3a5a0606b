"""The wheels and zips of a release: what is written into them, and what their binaries are checked for."""

import json
import re
import shutil
import subprocess
import sys
import zipfile
from importlib import import_module
from pathlib import Path

import cli_support
import koebe
import pytest
import tomllib

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"


# CMakeLists.txt sets it, and pip's package takes it from there by the pattern in pyproject.toml. The changelog's first
# heading and the citation say it too. Files for Blender get it when they are packed.
VERSIONS = {
    "CMakeLists.txt": re.search(r"regex = '''(.*)'''", (ROOT / "pyproject.toml").read_text(encoding="utf-8"))[1],
    "CITATION.cff": r"(?m)^version: (\S+)$",
    "scripts/conda/recipe.yaml": r'(?m)^  version: "(\S+)"$',
    "CHANGELOG.md": r"(?m)^## (\S+), (?:not released yet|\d{4}-\d\d-\d\d)$",
}


@pytest.mark.parametrize(("name", "pattern"), VERSIONS.items())
def test_the_version_is_one(name, pattern):
    found = re.search(pattern, (ROOT / name).read_text(encoding="utf-8"))[1]
    assert found == import_module("package_extension").project_version()


def test_the_release_page_says_what_is_new():
    notes = subprocess.check_output([SCRIPTS / "release_notes.sh", "https://forge/v1/"], text=True)
    lines = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").splitlines()
    begin = next(index for index, line in enumerate(lines) if line.startswith("## "))
    end = next(index for index, line in enumerate(lines) if line.startswith("### "))
    assert notes.replace("https://forge/v1/", "").splitlines() == lines[begin + 1 : end] and notes.strip()
    assert "](https://forge/v1/docs/parts.md#unfolded-surfaces)" in notes and "](docs" not in notes


def test_another_version_is_one_line(tmp_path):
    for name in ("addon", "scripts/package_extension.py", "scripts/guide_html.py", "scripts/version.sh",
                 "native/options", "docs/guide.md", "docs/troubleshooting.md", "docs/data",
                 "LICENSE"):  # fmt: skip
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, tmp_path / name)
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    text, count = re.subn(r"(?m)(?<=^project\(koebe VERSION )\S+", "7.8.9", text)
    (tmp_path / "CMakeLists.txt").write_text(text, encoding="utf-8")
    assert count == 1 and subprocess.check_output([tmp_path / "scripts/version.sh"], text=True) == "7.8.9\n"
    (tmp_path / "dist").mkdir()
    (tmp_path / "dist/koebe-7.8.9-py3-none-win_amd64.whl").write_bytes(b"")
    subprocess.run([sys.executable, tmp_path / "scripts/package_extension.py", "--release"], check=True)
    with zipfile.ZipFile(tmp_path / "dist/koebe_uv-7.8.9-windows-x64.zip") as archive:
        assert 'version = "7.8.9"' in archive.read("koebe_uv/blender_manifest.toml").decode()
        assert '"version": (7, 8, 9)' in archive.read("koebe_uv/__init__.py").decode()


def test_what_is_built_says_its_version():
    expected = import_module("package_extension").project_version()
    printed = subprocess.run([SCRIPTS / "version.sh"], capture_output=True, text=True, check=True).stdout.strip()
    command = cli_support.koebe("--version").stdout.strip()
    assert (koebe.__version__, command, printed) == (expected, expected, expected)


def bundle(folder, *names):
    (folder / "koebe").mkdir(parents=True)
    for name in names:
        (folder / "koebe" / name).parent.mkdir(exist_ok=True)
        (folder / "koebe" / name).write_bytes(name.encode())
    return folder


def test_a_bundle_becomes_one_wheel_whose_record_is_right(tmp_path, monkeypatch):
    build = bundle(tmp_path / "build", "libkoebe.so", "bin/koebe", "_koebe.cpython-311-x86_64-linux-gnu.so",
                   "_koebe.cpython-313-x86_64-linux-gnu.so")  # fmt: skip
    packer = import_module("pack_wheel")
    for out in ("one", "two"):
        tag = "py3-none-manylinux_2_28_x86_64"
        monkeypatch.setattr(sys, "argv", ["", "bundle", str(build), tag, str(tmp_path / out)])
        packer.main()
    (wheel,), (again,) = ((tmp_path / out).glob("*.whl") for out in ("one", "two"))
    assert wheel.name.endswith("-py3-none-manylinux_2_28_x86_64.whl")
    assert wheel.read_bytes() == again.read_bytes()
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        info = next(name for name in names if name.endswith("RECORD")).rpartition("/")[0]
        metadata = archive.read(f"{info}/METADATA").decode()
        lines = archive.read(f"{info}/RECORD").decode().splitlines()
        for line in lines[:-1]:
            name = line.rsplit(",", 2)[0]
            assert packer.record_line(name, archive.read(name)).strip() == line
    assert {line.rsplit(",", 2)[0] for line in lines} == set(names)
    assert {"koebe/__init__.py", "koebe/libkoebe.so", "koebe/bin/koebe", "koebe/py.typed"} < set(names)
    assert f"{info}/sboms/koebe.cdx.json" in names
    assert "Requires-Python: >=3.10\n" in metadata and "Requires-Dist: numpy" in metadata
    assert "\n\n# koebe\n" in metadata
    assert not re.search(r"\]\((?!https:)", metadata)  # a package index has no other pages


def test_a_wheel_lists_what_it_holds_of_others():
    maker = import_module("sbom")
    bill = json.loads(maker.sbom("1.2.3", "GPL-3.0-or-later", "manylinux_2_28_x86_64"))
    assert (bill["bomFormat"], bill["specVersion"]) == ("CycloneDX", "1.6")
    assert bill["metadata"]["component"]["purl"] == "pkg:pypi/koebe@1.2.3"
    names = {item["bom-ref"] for item in bill["components"]}
    assert len(names) == len(bill["components"]) == 19 and set(bill["dependencies"][0]["dependsOn"]) == names
    addresses = {item["name"]: item["purl"] for item in bill["components"]}
    assert addresses["Eigen"].startswith("pkg:deb/debian/libeigen3-dev@3.4.0-")
    assert addresses["pybind11"].startswith("pkg:pypi/pybind11@")
    windows = json.loads(maker.sbom("1.2.3", "GPL-3.0-or-later", "win_amd64"))
    assert len(windows["components"]) == 20 and windows["serialNumber"] != bill["serialNumber"]
    mac = json.loads(maker.sbom("1.2.3", "GPL-3.0-or-later", "macosx_11_0_arm64"))
    assert len(mac["components"]) == 19


def test_the_list_of_others_names_the_pinned_versions():
    maker = import_module("sbom")
    pinned, parts = maker.pinned(), maker.parts()
    assert {part.package for part in parts} == set(pinned)
    inside = {"RapidXML, with namespaces (of svgpp)", "stb_image"}  # their packages have another number
    for part in parts:
        assert part.name in inside or re.search(r"\d[\d.]*\d", part.version)[0] in pinned[part.package], part
        assert re.fullmatch(r"[A-Za-z0-9.-]+(?: (?:AND|OR|WITH) [A-Za-z0-9.-]+)?", part.licence), part


def test_what_is_no_bundle_makes_no_wheel(tmp_path, monkeypatch):
    packer = import_module("pack_wheel")
    for number, names in enumerate([
        ("libkoebe.so", "bin/koebe"), ("_koebe.cpython-311-darwin.so", "bin/koebe"),
        ("libkoebe.so", "_koebe.cpython-311-x86_64-linux-gnu.so")]):
        build = bundle(tmp_path / str(number), *names)
        monkeypatch.setattr(sys, "argv", ["", "bundle", str(build), "py3-none-linux_x86_64", str(tmp_path / "out")])
        with pytest.raises(SystemExit, match="holds no bundle"):
            packer.main()


@pytest.mark.skipif(sys.platform != "linux", reason="make build packs wheels on Linux")
def test_a_wheel_of_this_machine_has_the_libraries_that_others_lack(tmp_path, monkeypatch):
    module, command = Path(koebe._koebe.__file__), Path(cli_support.COMMAND)
    tag = "cp{0}{1}-cp{0}{1}-linux_x86_64".format(*sys.version_info)
    monkeypatch.setattr(sys, "argv", ["", "local", str(module), str(command), tag, str(tmp_path)])
    import_module("pack_wheel").main()
    (wheel,) = tmp_path.glob(f"koebe-*-{tag}.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = {name.removeprefix("koebe/") for name in archive.namelist()}
        needed = {name for binary in (module.name, "bin/koebe")
                  for name in import_module("binary_facts").facts_of(archive.read(f"koebe/{binary}")).libraries}
    assert {"__init__.py", "bin/koebe", module.name} < names
    assert {name for name in needed - names if not re.match(import_module("pack_wheel").SYSTEM, name)} == set()


def test_a_release_has_a_zip_for_each_platform_and_leaves_the_one_of_this_machine(tmp_path, monkeypatch):
    packer = import_module("package_extension")
    version = packer.project_version()
    for tag in ("cp311-cp311-linux_x86_64", "py3-none-manylinux_2_28_x86_64", "py3-none-win_amd64"):
        (tmp_path / f"koebe-{version}-{tag}.whl").write_bytes(tag.encode())
    contents = []
    for options in ([], ["--release"], [], ["--release"]):
        monkeypatch.setattr(sys, "argv", ["", "--dist", str(tmp_path), *options])
        packer.main()
        contents.append({package.name: package.read_bytes() for package in tmp_path.glob("*.zip")})
    assert contents[1] == contents[3]
    wheels = {}
    for package in tmp_path.glob("*.zip"):
        with zipfile.ZipFile(package) as archive:
            wheels[package.name.removeprefix("koebe_uv-")] = sorted(
                name.rpartition("/")[2].split("-", 2)[2] for name in archive.namelist() if name.endswith(".whl"))
            manifest = archive.read("koebe_uv/blender_manifest.toml").decode()
            assert manifest.count("./wheels/") == len(wheels[package.name.removeprefix("koebe_uv-")])
    linux, windows = "py3-none-manylinux_2_28_x86_64.whl", "py3-none-win_amd64.whl"
    assert wheels == {
        f"{version}.zip": ["cp311-cp311-linux_x86_64.whl"],
        f"{version}-linux-x64.zip": [linux],
        f"{version}-windows-x64.zip": [windows],
        f"{version}-all.zip": [linux, windows],
    }


@pytest.mark.skipif(sys.platform != "linux", reason="reads this interpreter's own module")
def test_a_binary_says_what_it_needs():
    facts = import_module("binary_facts").facts_of(Path(koebe._koebe.__file__).read_bytes())
    assert any(name.startswith("libc.so") for name in facts.libraries)
    assert any(name.startswith("GLIBC_2.") for name in facts.versions)


def test_a_binary_that_asks_too_much_is_named():
    check, facts = import_module("check_dist"), import_module("binary_facts").Facts
    tag = "manylinux_2_28_x86_64"
    good = facts("x86_64", ["libc.so.6", "libm.so.6", "libkoebe.so"], ["GLIBC_2.28", "GLIBC_2.2.5"])
    assert check.problems_of(good, "manylinux", tag) == []
    bad = facts("aarch64", ["libgfortran.so.5", "libc.so.6"], ["GLIBC_2.34", "GLIBCXX_3.4.29"])
    assert check.problems_of(bad, "manylinux", tag) == [
        "is for aarch64", "needs libgfortran.so.5", "needs GLIBC_2.34, GLIBCXX_3.4.29"]
    mac = facts("aarch64", ["/usr/lib/libSystem.B.dylib"], minimum_os=(13, 0), signed=False)
    assert [problem.split()[0] for problem in check.problems_of(mac, "macosx", "macosx_11_0_arm64")] == ["is", "has"]


def test_the_page_of_the_platform_says_what_the_manifest_says():
    said = tomllib.loads((ROOT / "addon" / "blender_manifest.toml").read_text(encoding="utf-8"))
    listing = (ROOT / "scripts" / "listing" / "listing.md").read_text(encoding="utf-8")
    table = dict(re.findall(r"(?m)^\| (.*?) \| (.*?) \|$", listing))
    assert (table["name"], table["tagline"]) == (said["name"], said["tagline"])
    assert table["tags"].split(", ") == said["tags"]
    reasons = {key.split("*")[1]: text for key, text in table.items() if key.startswith("permission *")}
    assert reasons == said["permissions"]
    for text in [said["tagline"], *said["permissions"].values()]:  # as Blender checks them
        assert len(text) <= 64 and text[-1].isalnum()


def test_a_binary_does_not_say_where_it_was_built():
    paths = import_module("check_dist").machine_paths
    assert paths(b"\0build/sources/headers/usr/include/CGAL/a.h\0/usr/include/b.h\0") == []
    assert paths(b"\0/home/me/koebe/build/sources/a.c\0") == [
        "says /home/me/koebe/build/sources/a.c, a place on the machine that built it"]


# conda-forge's names for what scripts/install.sh takes from Debian.
CONDA = {
    "libopenmesh-dev": "openmesh", "libeigen3-dev": "eigen", "libsuitesparse-dev": "libcholmod",
    "libcgal-dev": "cgal-cpp", "liblemon-dev": "lemon", "libfast-float-dev": "fast_float", "libsvgpp-dev": "svgpp",
    "libstb-dev": "stb", "libtinygltf-dev": "tinygltf", "nlohmann-json3-dev": "nlohmann_json",
    "libcli11-dev": "cli11", "libuv1-dev": "libuv", "libsodium-dev": "libsodium",
}  # fmt: skip
ONLY_TESTS = {"libgtest-dev", "libbenchmark-dev"}


def test_the_recipe_for_conda_has_what_the_package_needs():
    recipe = (ROOT / "scripts" / "conda" / "recipe.yaml").read_text(encoding="utf-8")
    host, run = (re.search(rf"(?m)^  {name}:\n((?:    - .*\n)+)", recipe)[1] for name in ("host", "run"))
    build = re.search(r'\[build\]="(.*?)"', (SCRIPTS / "install.sh").read_text(encoding="utf-8"), re.DOTALL)[1]
    debian = {word for word in build.split() if re.match(r"(lib|nlohmann)", word)} - ONLY_TESTS
    assert debian == set(CONDA)
    assert {line.split()[1] for line in host.splitlines()} >= set(CONDA.values())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    pins = [*project["build-system"]["requires"], *project["project"]["dependencies"]]
    pins.append("python" + project["project"]["requires-python"])
    for pin in pins:
        name, least = pin.split(">=")
        assert f"- {name} >={least}\n" in host + run, pin
    assert f"summary: {project['project']['description']}\n" in recipe
    assert f"license: {project['project']['license']}\n" in recipe
