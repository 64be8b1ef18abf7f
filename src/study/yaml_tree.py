"""A YAML file as a tree whose every node knows its line."""
import dataclasses

import yaml

from problems import InputError


@dataclasses.dataclass
class Node:
    """`value` is a text, a list of nodes, or a dict from text to node."""
    value: object
    place: str  # file:line:column

    @property
    def is_list(self):
        return isinstance(self.value, list)

    @property
    def is_map(self):
        return isinstance(self.value, dict)

    @property
    def text(self):
        """As mpm_par's --set takes it: one line of YAML."""
        if self.is_list:
            return "[" + ", ".join(node.text for node in self.value) + "]"
        if self.is_map:
            return "{" + ", ".join(f"{key}: {node.text}" for key, node in self.value.items()) + "}"
        return self.value

    def wrong(self, what, remedy):
        """The error to raise, with the place of this node."""
        return InputError(f"{self.place}: {what}. {remedy}")


def _converted(node, file):
    place = f"{file}:{node.start_mark.line + 1}:{node.start_mark.column + 1}"
    if isinstance(node, yaml.ScalarNode):
        return Node(node.value, place)
    if isinstance(node, yaml.SequenceNode):
        return Node([_converted(item, file) for item in node.value], place)
    entries = {}
    for key, value in node.value:
        key_place = f"{file}:{key.start_mark.line + 1}:{key.start_mark.column + 1}"
        if not isinstance(key, yaml.ScalarNode):
            raise InputError(f"{key_place}: a key is a list or a map. Write a word.")
        if key.value in entries:
            raise InputError(f"{key_place}: {key.value} is given twice. Keep one of them.")
        entries[key.value] = _converted(value, file)
    return Node(entries, place)


def read_value(text, place):
    """The tree of a value, as --set takes it; what is no YAML is a text."""
    try:
        root = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.YAMLError:
        root = None
    return Node(text, place) if root is None else _converted(root, place)


def read_yaml(path):
    """The tree of a file; an InputError with the line where it is no YAML."""
    try:
        with open(path, encoding="utf-8") as file:
            root = yaml.compose(file, Loader=yaml.SafeLoader)
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}). "
                         "Check the path.") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: is no text ({error.reason}). Name a YAML file.") from error
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = f"{path}:{mark.line + 1}:{mark.column + 1}" if mark else str(path)
        why = getattr(error, "problem", None) or str(error)
        raise InputError(f"{place}: is no YAML ({why}). Check brackets and indents.") from error
    if root is None:
        raise InputError(f"{path}: is empty. Write the keys of docs/studies.md.")
    return _converted(root, path)
