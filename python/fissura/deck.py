"""A case as a dictionary with the keys of the deck, written as the deck."""


def value(item):
    """A Python value as TOML: texts, numbers, flags, lists and dictionaries."""
    if hasattr(item, "tolist"):  # numpy arrays and numbers
        item = item.tolist()
    if isinstance(item, bool):
        return "true" if item else "false"
    if isinstance(item, (int, float)):
        return repr(item)
    if isinstance(item, str):
        return '"' + "".join(_escaped(c) for c in item) + '"'
    if isinstance(item, dict):
        return "{" + ", ".join(f"{_key(k)} = {value(v)}" for k, v in item.items()) + "}"
    if isinstance(item, (list, tuple)):
        return "[" + ", ".join(value(v) for v in item) + "]"
    raise TypeError(f"{item!r} cannot stand in a deck: use texts such as \"30 GPa\", numbers, lists and dictionaries")


def text(case):
    """The deck of a dictionary; a section with several entries, such as `bar`, is a list of dictionaries."""
    top, sections = [], []
    for key, item in case.items():
        if isinstance(item, dict):
            sections.append(_section(key, item))
        elif isinstance(item, (list, tuple)) and item and all(isinstance(i, dict) for i in item):
            sections += [_section(key, i, many=True) for i in item]
        else:
            top.append(f"{_key(key)} = {value(item)}")
    return "\n".join(top + sections) + "\n"


def _section(key, table, many=False):
    head = f"[[{_key(key)}]]" if many else f"[{_key(key)}]"
    return "\n".join(["", head] + [f"{_key(k)} = {value(v)}" for k, v in table.items()])


def _key(key):
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else value(str(key))


def _escaped(c):
    if c in '"\\':
        return "\\" + c
    return c if c.isprintable() else f"\\u{ord(c):04x}" if ord(c) < 0x10000 else f"\\U{ord(c):08x}"
