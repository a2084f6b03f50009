"""How the fixtures are written: JSON that a person can read."""

import json


def lines(value, indent=""):
    """JSON in which whatever fits a line of 140 columns, an inertia say, stands on one."""
    short = json.dumps(value, ensure_ascii=False, allow_nan=False)
    if len(indent) + len(short) <= 139 or not isinstance(value, (dict, list)):
        return short
    deeper = indent + " "
    if isinstance(value, dict):
        inner = [f"{json.dumps(key)}: {lines(x, deeper)}" for key, x in value.items()]
    else:
        inner = [lines(x, deeper) for x in value]
    opening, closing = "{}" if isinstance(value, dict) else "[]"
    return f"{opening}\n{deeper}" + f",\n{deeper}".join(inner) + f"\n{indent}{closing}"
