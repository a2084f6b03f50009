"""How the fixtures are written: JSON with a line for each spacecraft or sample, so that a change shows whose it is."""

import json


def lines(document):
    """JSON of an object, each member on a line, and of a list each element."""
    members = [f" {compact(key)}: {elements(value)}" for key, value in document.items()]
    return "{\n" + ",\n".join(members) + "\n}"


def elements(value):
    """JSON of a list of objects or lists, each on a line; of anything else on one."""
    if not isinstance(value, list) or not any(isinstance(x, (dict, list)) for x in value):
        return compact(value)
    return "[\n  " + ",\n  ".join(map(compact, value)) + "\n ]"


def compact(value):
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
