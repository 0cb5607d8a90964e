"""Small datasets on meshes, written with h5py."""

import h5py
import numpy as np

TEXT = h5py.string_dtype()
TYPES = {
    "u1": "shape map_degree map_space clip_side block_degree block_space level",
    "u4": "element clip_field patch_blocks block_function",
    "u8": "map_offset clip_offsets block_offset offsets parameter_offsets",
    "i8": "crack levels point",
}
TYPE = {name: kind for kind, names in TYPES.items() for name in names.split()}
PLAIN = dict(kind="one", crack=-1, formula="", frame="", frame_end="", frame_angle=0.0)


def write(path, arrays, libver=None, gzip=False):
    """Writes arrays and attributes by their paths in the format; with `gzip` long ones are deflated."""
    with h5py.File(path, "w", libver=libver) as file:
        file.attrs.update(format="ppum", format_version=np.array([1, 5], "u4"))
        for name, values in arrays.items():
            group, _, attribute = name.partition("@")
            if "@" in name:
                file.require_group(group or "/").attrs[attribute] = values
                continue
            values = np.asarray(values)
            last = name.split("/")[-1]
            kind = TEXT if values.dtype.kind in "OUS" or last == "parameter_name" else TYPE.get(last, "f8")
            how = {"compression": "gzip", "shuffle": True} if gzip and kind != TEXT and values.size > 300 else {}
            file.create_dataset(name, data=values.astype(object if kind == TEXT else kind), dtype=kind, **how)


def element(shape, origin, coefficients, space=0, clips=(), blocks=()):
    """A patch. `coefficients` are those of its map, two rows; `clips` pairs of a field and a side; `blocks` has for each
    field a list of (function, space, coefficients of the components)."""
    return dict(shape=shape, origin=origin, map=np.array(coefficients, float), space=space, clips=clips, blocks=blocks)


def mesh(elements, fields=(("u", ["u"]),), functions=(), box=((-9, -9), (9, 9))):
    """The arrays of a dataset of one step: `fields` are names and components, `functions` what differs from `PLAIN`."""
    step = {
        "partition/shape": [e["shape"] for e in elements],
        "partition/origin": [e["origin"] for e in elements],
        "partition/map_degree": [degree(e["map"].shape[1] + 1, e["space"]) for e in elements],
        "partition/map_space": [e["space"] for e in elements],
        "partition/map_offset": offsets([e["map"].shape[1] for e in elements])[:-1],
        "partition/map": np.hstack([e["map"] for e in elements]),
        "partition/element": np.arange(len(elements)),
        "cracks/points": np.empty((0, 2)),
        "cracks/offsets": [0],
        "cracks/ends": np.empty((0, 2), object),
    }
    if any(e["clips"] for e in elements):
        clips = np.array([clip for e in elements for clip in e["clips"]])
        step |= {"partition/clip_offsets": offsets([len(e["clips"]) for e in elements])}
        step |= {"partition/clip_field": clips[:, 0], "partition/clip_side": clips[:, 1]}
    rows = [PLAIN | dict(name=str(k)) | row for k, row in enumerate([{}, *functions])]
    step |= {f"functions/{key}": [row[key] for row in rows] for key in rows[0] if key != "levels"}
    if any("levels" in row for row in rows):
        step["functions/levels"] = [row.get("levels", (-1, -1)) for row in rows]
    step["functions/frame_origin"] = np.zeros((len(rows), 2))
    step |= {"functions/parameter_offsets": [0] * (len(rows) + 1), "functions/parameter_value": []}
    step["functions/parameter_name"] = np.empty(0, object)
    for k, (name, components) in enumerate(fields):
        path = f"fields/{k:04}"
        step |= {f"{path}@name": name, f"{path}@unit": "", f"{path}/components": components}
        step |= {f"{path}/{key}": v for key, v in field([e["blocks"][k] for e in elements], len(components)).items()}
    head = {"@program": "by hand", "@title": "Mesh", "equation@kind": "none", "domain@kind": "mesh"}
    head |= {"domain@min": np.array(box[0], float), "domain@max": np.array(box[1], float)}
    head |= {"steps/0000@load": 1.0, "steps/0000/partition@kind": "mesh"}
    return head | {f"steps/0000/{key}": v for key, v in step.items()}


def field(patches, components):
    """The arrays of a field from the blocks of each patch."""
    blocks = [block for patch in patches for block in patch]
    columns = [np.array(c, float).reshape(components, -1) for *_, c in blocks]
    return {
        "patch_blocks": offsets(list(map(len, patches))),
        "block_function": [f for f, *_ in blocks],
        "block_space": [space for _, space, _ in blocks],
        "block_degree": [degree(c.shape[1], space) for (_, space, _), c in zip(blocks, columns)],
        "block_offset": offsets([c.shape[1] for c in columns])[:-1],
        "coefficients": np.hstack(columns),
    }


def offsets(sizes):
    return np.concatenate([[0], np.cumsum(sizes)]).astype(int)


def degree(count, space):
    sizes = {(d + 1) ** 2 if space else (d + 1) * (d + 2) // 2: d for d in range(9)}
    return sizes[count]
