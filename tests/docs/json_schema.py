"""As much of JSON Schema (draft 2020-12) as docs/report.schema.json uses; another keyword is an error, so that none is
passed over in silence."""

import re

TYPES = {"number": (int, float), "integer": int, "string": str, "boolean": bool, "array": list, "object": dict,
         "null": type(None)}
NOTES = {"$schema", "$defs", "title", "description"}


def is_a(value, name):
    return isinstance(value, TYPES[name]) and (name == "boolean" or not isinstance(value, bool))


class Schema:
    """`seen`: places in the schema, as "#/$defs/part/id", of the properties that the values checked so far had."""

    def __init__(self, document):
        self.document = document
        self.seen = set()

    def at(self, reference):
        found = self.document
        for step in reference.removeprefix("#/").split("/"):
            found = found[step]
        return found

    def errors(self, value, rule=None, path="report", place="#"):
        """What is wrong with the value, as sentences; none where it is as the rule says."""
        rule = self.document if rule is None else rule
        for keyword, operand in rule.items():
            if keyword not in NOTES:
                check = getattr(self, "check_" + keyword.removeprefix("$"), None)
                if check is None:
                    raise ValueError(f"{place}: no check of {keyword}")
                yield from check(value, operand, rule, path, place)

    def check_ref(self, value, reference, rule, path, place):
        yield from self.errors(value, self.at(reference), path, reference)

    def check_oneOf(self, value, rules, rule, path, place):
        fits = sum(not any(self.errors(value, each, path, place)) for each in rules)
        if fits != 1:
            yield f"{path} fits to {fits} of {len(rules)} forms"

    def check_type(self, value, names, rule, path, place):
        names = [names] if isinstance(names, str) else names
        if not any(is_a(value, name) for name in names):
            yield f"{path} is no {' or '.join(names)}"

    def check_const(self, value, wanted, rule, path, place):
        if value != wanted:
            yield f"{path} is not {wanted}"

    def check_enum(self, value, allowed, rule, path, place):
        if value not in allowed:
            yield f"{path} is {value}, none of {allowed}"

    def check_pattern(self, value, pattern, rule, path, place):
        if isinstance(value, str) and not re.search(pattern, value):
            yield f"{path} is {value}, not {pattern}"

    def check_minimum(self, value, least, rule, path, place):
        if is_a(value, "number") and value < least:
            yield f"{path} is below {least}"

    def check_minItems(self, value, least, rule, path, place):
        if isinstance(value, list) and len(value) < least:
            yield f"{path} has fewer than {least} items"

    def check_maxItems(self, value, most, rule, path, place):
        if isinstance(value, list) and len(value) > most:
            yield f"{path} has more than {most} items"

    def check_required(self, value, names, rule, path, place):
        if isinstance(value, dict):
            yield from (f"{path} has no {name}" for name in names if name not in value)

    def check_properties(self, value, properties, rule, path, place):
        if not isinstance(value, dict):
            return
        for name, inner in properties.items():
            if name in value:
                self.seen.add(f"{place}/{name}")
                yield from self.errors(value[name], inner, f"{path}.{name}", f"{place}/{name}")

    def check_additionalProperties(self, value, inner, rule, path, place):
        if isinstance(value, dict):
            for name in value.keys() - rule.get("properties", {}).keys():
                yield from self.errors(value[name], inner, f"{path}.{name}", f"{place}/*")

    def check_items(self, value, inner, rule, path, place):
        if isinstance(value, list):
            for k, item in enumerate(value):
                yield from self.errors(item, inner, f"{path}[{k}]", f"{place}[]")

    def properties(self):
        """The place of every property that the schema names."""
        def below(rule, place):
            for name, inner in rule.get("properties", {}).items():
                yield f"{place}/{name}"
                yield from below(inner, f"{place}/{name}")
            if "items" in rule:
                yield from below(rule["items"], f"{place}[]")
        for name, rule in self.document["$defs"].items():
            yield from below(rule, f"#/$defs/{name}")
