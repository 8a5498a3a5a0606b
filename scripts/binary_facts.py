"""What a compiled library asks of its system, read from its own tables: ELF, PE and Mach-O. Standard library only.

[System V ABI, chapters 4 and 5, and the gABI's symbol versioning; Microsoft, PE Format; Apple, mach-o/loader.h]
"""

import dataclasses
import struct


@dataclasses.dataclass
class Facts:
    """What is said of one library.

    machine     the processor's name
    libraries   those it loads
    versions    on Linux the symbol versions it needs of them: "GLIBC_2.14"
    minimum_os  on macOS
    signed      on macOS whether it has a code signature
    """

    machine: str
    libraries: list[str]
    versions: list[str] = dataclasses.field(default_factory=list)
    minimum_os: tuple[int, int] | None = None
    signed: bool | None = None


def facts_of(content: bytes) -> Facts:
    """The facts of a 64-bit library."""
    if content[:4] == b"\x7fELF":
        return _elf(content)
    if content[:4] == b"\xcf\xfa\xed\xfe":
        return _macho(content)
    if content[:2] == b"MZ":
        return _pe(content)
    raise ValueError("neither ELF nor Mach-O nor PE")


def _text(content: bytes, start: int) -> str:
    return content[start:content.index(b"\0", start)].decode()


def _elf(content: bytes) -> Facts:
    machine = {62: "x86_64", 183: "aarch64"}[struct.unpack_from("<H", content, 18)[0]]
    (first,), (size, count) = struct.unpack_from("<Q", content, 40), struct.unpack_from("<HH", content, 58)
    sections = [struct.unpack_from("<IIQQQQIIQQ", content, first + size * k) for k in range(count)]
    libraries, versions = [], []
    for _, kind, _, _, offset, length, link, _, _, _ in sections:
        names = sections[link][4] if link < count else 0
        if kind == 6:  # SHT_DYNAMIC
            entries = struct.iter_unpack("<QQ", content[offset:offset + length])
            libraries += [_text(content, names + value) for tag, value in entries if tag == 1]  # DT_NEEDED
        if kind == 0x6FFFFFFE:  # SHT_GNU_verneed
            need = offset
            while True:
                _, entries, _, auxiliary, following = struct.unpack_from("<HHIII", content, need)
                place = need + auxiliary
                for _ in range(entries):
                    _, _, _, name, step = struct.unpack_from("<IHHII", content, place)
                    versions.append(_text(content, names + name))
                    place += step
                if not following:
                    break
                need += following
    return Facts(machine, libraries, sorted(set(versions)))


def _macho(content: bytes) -> Facts:
    machine = {0x01000007: "x86_64", 0x0100000C: "aarch64"}[struct.unpack_from("<I", content, 4)[0]]
    (count,), place = struct.unpack_from("<I", content, 16), 32
    facts = Facts(machine, [], signed=False)
    for _ in range(count):
        command, size = struct.unpack_from("<II", content, place)
        if command & 0x7FFFFFFF in (0xC, 0x18, 0x1F):  # LC_LOAD_DYLIB, its weak and its re-exporting kind
            facts.libraries.append(_text(content, place + struct.unpack_from("<I", content, place + 8)[0]))
        elif command == 0x32:  # LC_BUILD_VERSION
            version = struct.unpack_from("<I", content, place + 12)[0]
            facts.minimum_os = version >> 16, version >> 8 & 0xFF
        elif command == 0x24:  # LC_VERSION_MIN_MACOSX
            version = struct.unpack_from("<I", content, place + 8)[0]
            facts.minimum_os = version >> 16, version >> 8 & 0xFF
        elif command == 0x1D:  # LC_CODE_SIGNATURE
            facts.signed = True
        place += size
    return facts


def _pe(content: bytes) -> Facts:
    (header,) = struct.unpack_from("<I", content, 0x3C)
    code, count = struct.unpack_from("<HH", content, header + 4)
    (optional_size,) = struct.unpack_from("<H", content, header + 20)
    optional = header + 24
    sections = [struct.unpack_from("<8xIII", content, optional + optional_size + 40 * k)
                + struct.unpack_from("<I", content, optional + optional_size + 40 * k + 20) for k in range(count)]

    def place(address: int) -> int:
        for virtual_size, virtual, raw_size, raw in sections:
            if virtual <= address < virtual + max(virtual_size, raw_size):
                return address - virtual + raw
        raise ValueError(f"address {address:#x} in no section")

    (imports,) = struct.unpack_from("<I", content, optional + 112 + 8)
    libraries, entry = [], place(imports)
    while any(content[entry:entry + 20]):
        libraries.append(_text(content, place(struct.unpack_from("<I", content, entry + 12)[0])))
        entry += 20
    return Facts({0x8664: "x86_64", 0xAA64: "aarch64"}[code], libraries)
