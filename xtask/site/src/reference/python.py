"""Prints, as JSON, what a package says of its public names: read from the sources, nothing is imported."""

import ast
import json
import sys
from pathlib import Path

PACKAGE = Path(sys.argv[1])


def tree_of(path):
    return ast.parse(path.read_text(encoding="utf-8"))


def exported(tree):
    for node in tree.body:
        if isinstance(node, ast.Assign) and any(isinstance(t, ast.Name) and t.id == "__all__" for t in node.targets):
            return [ast.literal_eval(element) for element in node.value.elts]
    return []


def signature_of(node, of_class=False):
    arguments = ast.unparse(node.args)
    if of_class:
        first = arguments.split(", ", 1)
        arguments = first[1] if len(first) > 1 else ""
        arguments = arguments.removeprefix("/, ")
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    name = node.name
    text = f"{name}({arguments}){returns}"
    if len(text) > 100:
        body = arguments.replace(", ", ",\n    ") if "[" not in arguments else arguments
        text = f"{name}(\n    {body}\n){returns}"
    return text


def item_of(node):
    doc = ast.get_docstring(node) or ""
    if not isinstance(node, ast.ClassDef):
        return {"name": node.name, "signature": signature_of(node), "doc": doc, "members": []}
    members = []
    signature = f"class {node.name}"
    if node.bases:
        signature += "(" + ", ".join(ast.unparse(base) for base in node.bases) + ")"
    for member in node.body:
        if isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name) and not member.target.id.startswith("_"):
            signature += f"\n    {member.target.id}: {ast.unparse(member.annotation)}"
        if not isinstance(member, ast.FunctionDef):
            continue
        if member.name == "__init__":
            signature += "\n    " + signature_of(member, of_class=True)
        elif not member.name.startswith("_") and ast.get_docstring(member):
            decorators = {ast.unparse(decorator) for decorator in member.decorator_list}
            shown = f"{member.name} -> {ast.unparse(member.returns)}" if "property" in decorators and member.returns else None
            members.append(
                {
                    "name": member.name,
                    "signature": shown or signature_of(member, of_class=True),
                    "doc": ast.get_docstring(member) or "",
                    "members": [],
                }
            )
    return {"name": node.name, "signature": signature, "doc": doc, "members": members}


def path_of(module):
    path = PACKAGE.joinpath(*module.split("."))
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def find(path, package, name):
    """The definition of a name, through the module that it is imported from."""
    tree = tree_of(path)
    for node in ast.walk(tree):
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name == name:
            return node
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level and any((a.asname or a.name) == name for a in node.names):
            base = package if node.level == 1 else ""
            module = ".".join(part for part in (base, node.module or "") if part)
            if module and path_of(module).is_file() and path_of(module) != path:
                return find(path_of(module), module.rpartition(".")[0] if not path_of(module).name == "__init__.py" else module, name)
    return None


def module_of(name, path):
    tree = tree_of(path)
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    items = []
    for public in exported(tree):
        node = find(path, package, public)
        if node is not None:
            items.append(item_of(node))
    full = f"precess.{name}" if name else "precess"
    return {"name": full, "doc": ast.get_docstring(tree) or "", "items": items}


def public_modules():
    """Modules without an underscore whose names the package itself does not all give."""
    top = set(exported(tree_of(PACKAGE / "__init__.py")))
    names = []
    for path in sorted(PACKAGE.iterdir()):
        if path.name.startswith("_") or not (path.suffix == ".py" or (path / "__init__.py").is_file()):
            continue
        name = path.stem
        if name in top or not set(exported(tree_of(path_of(name)))) <= top:
            names.append(name)
    return names


modules = [module_of("", PACKAGE / "__init__.py")]
modules += [module_of(name, path_of(name)) for name in public_modules()]
print(json.dumps(modules))
