"""The bill of materials of the wheels of `make dist`, as JSON [CycloneDX 1.6]. Standard library only.

Components, versions and licences come from the first table of THIRD_PARTY.md, the pinned packages from
scripts/fetch_sources.sh (Debian) and native/bundle/requirements.txt (PyPI). A wheel has the bill in its
.dist-info/sboms/ [PEP 770]. It names no date and no machine: equal input gives equal text.
"""

import json
import re
import uuid
from pathlib import Path
from typing import NamedTuple
from urllib.parse import quote

ROOT = Path(__file__).resolve().parent.parent
TABLE, FETCHED, BUILT_WITH = "THIRD_PARTY.md", "scripts/fetch_sources.sh", "native/bundle/requirements.txt"
NAME = "koebe.cdx.json"


class Part(NamedTuple):
    """A row of the table."""

    name: str
    version: str
    licence: str
    package: str
    purpose: str


def parts() -> list[Part]:
    """All rows of the first table of THIRD_PARTY.md."""
    first = re.search(r"^\| what .*?\n\n", (ROOT / TABLE).read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)[0]
    return [Part(*(cell.strip() for cell in row.strip("|").split("|"))) for row in first.strip().splitlines()[2:]]


def pinned() -> dict[str, str]:
    """Package -> its address, with the pinned version [package-url/purl-spec]."""
    found = {}
    for kind, names in re.findall(r"^(source|header)_packages=\((.*?)\)", (ROOT / FETCHED).read_text(encoding="utf-8"),
                                  re.MULTILINE | re.DOTALL):
        for name, epoch, version in re.findall(r"(\S+?)=(?:(\d+):)?(\S+)", names):
            facts = {"arch": "source" if kind == "source" else "", "distro": "bookworm", "epoch": epoch}
            listed = "&".join(f"{key}={value}" for key, value in facts.items() if value)
            found[name] = f"pkg:deb/debian/{name}@{quote(version)}?{listed}"
    for name, version in re.findall(r"^(\S+)==(\S+)", (ROOT / BUILT_WITH).read_text(encoding="utf-8"), re.MULTILINE):
        found[name] = f"pkg:pypi/{name}@{version}"
    return found


def component(part: Part, address: str) -> dict[str, object]:
    return {
        "type": "library",
        "bom-ref": part.name,
        "name": part.name.removesuffix(" (Windows)"),
        "version": part.version.removeprefix("as in "),
        "description": part.purpose,
        "licenses": [{"expression": part.licence}],
        "purl": address,
    }


def sbom(version: str, licence: str, tag: str) -> str:
    """The text of the bill of materials of the wheel with that platform tag."""
    addresses = pinned()
    inside = [component(part, addresses[part.package]) for part in parts()
              if "win" in tag.split("_")[0] or not part.name.endswith("(Windows)")]
    koebe = {"type": "library", "bom-ref": "koebe", "name": "koebe", "version": version,
             "licenses": [{"expression": licence}], "purl": f"pkg:pypi/koebe@{version}"}
    bill = {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": koebe},
        "components": inside,
        "dependencies": [{"ref": "koebe", "dependsOn": [item["bom-ref"] for item in inside]}],
    }
    bill["serialNumber"] = f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(bill) + tag)}"
    return json.dumps(bill, indent=2) + "\n"
