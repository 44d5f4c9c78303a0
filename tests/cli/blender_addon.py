# SPDX-License-Identifier: Apache-2.0
"""Uses every part of the add-on: blender --background … --python blender_addon.py -- FOLDER PROGRAM

FOLDER has addon.zip and heads/ of `crowdface synth`.
"""
import json
import os
import subprocess
import sys
import time

import bpy
import numpy
from mathutils import Matrix

folder, program_path = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.preferences.addon_install(filepath=os.path.join(folder, "addon.zip"))
bpy.ops.preferences.addon_enable(module="crowdface_blender")
bpy.context.preferences.addons["crowdface_blender"].preferences.program = program_path

from crowdface_blender import crowds, faces, meshes, program  # noqa: E402

HEADS = ["synth_%02d" % number for number in range(1, 7)]


def empty_scene():
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)


def read_obj(file):
    return meshes.read_points(file) / 100 @ numpy.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])


def fails(operator, *words):
    try:
        operator()
    except RuntimeError as error:
        for word in words:
            assert word in str(error), f"{word!r} is not in {error}"
        return
    raise AssertionError(f"{operator} should fail")


def import_heads():
    """The heads in metres, side by side, by sex and age in sub-collections, the first with a shape key."""
    heads = bpy.data.collections.new("mob")
    bpy.context.scene.collection.children.link(heads)
    sexes = {name: bpy.data.collections.new(name) for name in ("female", "male")}
    ages = {}
    for collection in sexes.values():
        heads.children.link(collection)
    with open(os.path.join(folder, "heads", "tags.yaml"), encoding="utf-8") as file:
        tags = {line.split(":")[0].strip(): line for line in file if line.strip().startswith("synth")}
    for number, name in enumerate(HEADS):
        bpy.ops.wm.obj_import(filepath=os.path.join(folder, "heads", name + ".obj"), global_scale=0.01)
        (item,) = bpy.context.selected_objects
        item.location.x = 0.3 * number
        for collection in item.users_collection:
            collection.objects.unlink(item)
        sex = "female" if "female" in tags[name] else "male"
        age = next(age for age in ("young", "adult", "old") if age in tags[name])
        if (sex, age) not in ages:
            ages[sex, age] = bpy.data.collections.new(age)
            sexes[sex].children.link(ages[sex, age])
        ages[sex, age].objects.link(item)
    first = bpy.data.objects[HEADS[0]]
    first.shape_key_add(name="Basis")
    smile = first.shape_key_add(name="smile", from_mix=False)
    middle = len(first.data.vertices) // 2
    for point in smile.data[middle:middle + 30]:
        point.co.x += 0.3 if abs(point.co.x) > 1 else 0.003
    bpy.context.view_layer.update()
    return heads


def test_check(options):
    bpy.ops.crowdface.check()
    for name in HEADS:
        written = meshes.read_points(os.path.join(folder, "made", "heads", name + ".obj"))
        expected = read_obj(os.path.join(folder, "heads", name + ".obj"))
        assert numpy.abs(written - expected).max() < 1e-6, "vertices keep their order and do not move"
    with open(os.path.join(folder, "made", "heads", "synth_01.mtl"), encoding="utf-8") as file:
        images = [line.split()[1] for line in file if line.startswith("map_Kd")]
    with open(os.path.join(folder, "made", "heads", "synth_05.obj"), encoding="utf-8") as file:
        assert "usemtl skin\n" in file, "not skin.004"
    assert images and all(os.path.isfile(os.path.join(folder, "made", "heads", image)) for image in images), images
    other = bpy.data.objects[HEADS[2]]
    good, other.data = other.data, bpy.data.objects[HEADS[2]].data.copy()
    other.data.vertices.add(1)
    fails(bpy.ops.crowdface.check, "synth_03.obj: not the same mesh", "found")
    other.data = good
    heads, options.heads = options.heads, None
    fails(bpy.ops.crowdface.check, "choose a collection with heads")
    options.heads = heads


def test_generate(options):
    bpy.ops.crowdface.generate()
    crowd = crowds.read(os.path.join(folder, "made", "out", "mob"))
    assert [face.id for face in crowd.faces] == ["mob_family_1_01", "mob_family_1_02"] + [
        "mob_%04d" % number for number in range(1, 5)], [face.id for face in crowd.faces]
    assert {face.row["group"] for face in crowd.faces[2:]} == {"female", "male"}
    shown = imported()
    assert {item[faces.FACE] for item in shown} == {face.id for face in crowd.faces}
    for item in shown:
        assert [key.name for key in item.data.shape_keys.key_blocks] == ["Basis", "smile"]
        assert any(node.type == 'TEX_IMAGE' for slot in item.data.materials for node in slot.node_tree.nodes)
        low, high = bounds(item)
        assert 0.2 < high[2] - low[2] < 0.4, "metres, upright"
        assert abs(high[1] - item.location.y) < 0.3 and nose(item) < item.location.y - 0.05, "looks along -Y"
    assert scene.cycles.transparent_max_bounces == 64
    names = [item.name for item in shown]
    bpy.ops.crowdface.generate()
    assert [item.name for item in imported()] == names, "not shown twice"
    clear()
    return crowd


def points(item):
    return meshes.points_of(item) + numpy.array(item.matrix_world.translation)


def bounds(item):
    return points(item).min(axis=0), points(item).max(axis=0)


def nose(item):
    """The least y within 3 cm of the middle plane."""
    here = points(item)
    return here[numpy.abs(here[:, 0] - item.matrix_world.translation.x) < 0.03, 1].min()


def imported(level=0):
    return sorted((item for item in scene.objects if item.get(faces.FACE) and item[faces.LEVEL] == level),
                  key=lambda item: item.name)


def clear():
    for collection in [child for child in scene.collection.children if " faces" in child.name]:
        for item in list(collection.all_objects):
            bpy.data.objects.remove(item)
        for child in list(collection.children):
            bpy.data.collections.remove(child)
        bpy.data.collections.remove(collection)


def choose(browse, ids):
    for item in browse.faces:
        item.chosen = item.name in ids


def test_filters(browse, crowd):
    assert len(browse.filtered()) == 6
    browse.sex = "male"
    males = [item.name for item in browse.filtered()]
    assert males and males == [face.id for face in crowd.faces if face.row["sex"] == "male"]
    browse.sex = "*"
    browse.words = "female mob_0001"
    assert [item.name for item in browse.filtered()] == ["mob_0001"]
    browse.words = ""
    browse.trait = "nose_width"
    assert len(browse.filtered()) == 6, "from the least to the greatest"
    middle = sorted(float(face.row["nose_width"]) for face in crowd.faces)[2]
    browse.high = middle + 1e-3
    assert len(browse.filtered()) == 3
    bpy.ops.crowdface.choose(choose=True)
    assert len([item for item in browse.faces if item.chosen]) == 3
    browse.trait = "*"


def test_places(browse):
    choose(browse, [])
    fails(bpy.ops.crowdface.import_faces, "choose at least one face")
    choose(browse, ["mob_0001", "mob_0002", "mob_0003"])
    scene.cursor.location = (1, 2, 3)
    browse.place, browse.columns, browse.spacing = 'GRID', 2, 0.5
    bpy.ops.crowdface.import_faces()
    assert [tuple(item.location) for item in imported()] == [(1, 2, 3), (1.5, 2, 3), (1, 2.5, 3)]
    clear()

    browse.place = 'EMPTIES'
    fails(bpy.ops.crowdface.import_faces, "select empties")
    for number in range(5):
        empty = bpy.data.objects.new("place", None)
        scene.collection.objects.link(empty)
        empty.location, empty.rotation_euler = (number, 7, 0), (0, 0, 0.1 * number)
        empty.select_set(True)
    bpy.context.view_layer.update()
    bpy.ops.crowdface.import_faces()
    shown = imported()
    assert sorted(item.location.x for item in shown) == [0, 1, 2, 3, 4]
    assert len({item.data for item in shown}) == 3, "faces repeat and share their meshes"
    last = max(shown, key=lambda item: item.location.x)
    assert abs(last.matrix_world.to_euler().z - 0.4) < 1e-6
    clear()

    plane = bpy.data.objects.new("plane", bpy.data.meshes.new("plane"))
    plane.data.from_pydata([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], [], [(0, 1, 2, 3)])
    plane.location.z = 5
    scene.collection.objects.link(plane)
    bpy.context.view_layer.objects.active = plane
    for number, vertex in enumerate(plane.data.vertices):
        vertex.select = number in (1, 2)
    bpy.context.view_layer.update()
    browse.place = 'VERTICES'
    bpy.ops.crowdface.import_faces()
    assert [tuple(item.location) for item in imported()] == [(2, 0, 5), (2, 2, 5)]
    clear()
    return plane


def test_instances(browse, plane, crowd):
    """Geometry nodes put the hidden faces on the vertices of a mesh."""
    browse.place = 'INSTANCES'
    bpy.ops.crowdface.import_faces()
    tree = bpy.data.node_groups.new("crowd", 'GeometryNodeTree')
    (tree.inputs.new('NodeSocketGeometry', "in"), tree.outputs.new('NodeSocketGeometry', "out")) if hasattr(
        tree, "inputs") else [tree.interface.new_socket(name, in_out=way, socket_type='NodeSocketGeometry')
                              for name, way in (("in", 'INPUT'), ("out", 'OUTPUT'))]
    start, end = tree.nodes.new('NodeGroupInput'), tree.nodes.new('NodeGroupOutput')
    people, spread = tree.nodes.new('GeometryNodeCollectionInfo'), tree.nodes.new('GeometryNodeInstanceOnPoints')
    people.inputs["Collection"].default_value = bpy.data.collections[faces.name_of(crowd)]
    people.inputs["Separate Children"].default_value = True
    spread.inputs["Pick Instance"].default_value = True
    tree.links.new(start.outputs[0], spread.inputs["Points"])
    tree.links.new(people.outputs[0], spread.inputs["Instance"])
    tree.links.new(spread.outputs[0], end.inputs[0])
    modifier = plane.modifiers.new("crowd", 'NODES')
    modifier.node_group = tree
    graph = bpy.context.evaluated_depsgraph_get()
    at = {}
    for instance in graph.object_instances:
        if instance.is_instance and instance.parent.original == plane and instance.object.original.get(faces.FACE):
            at[tuple(round(x, 4) for x in instance.matrix_world.translation)] = instance.object.original[faces.FACE]
    assert set(at) == {(0, 0, 5), (2, 0, 5), (2, 2, 5), (0, 2, 5)}, at
    assert set(at.values()) == {"mob_0001", "mob_0002", "mob_0003"}
    assert not any(item.visible_get() for item in bpy.data.objects if item.get(faces.FACE))
    plane.modifiers.clear()
    clear()


def test_levels(browse):
    browse.place, browse.all_levels = 'CURSOR', True
    choose(browse, ["mob_0001"])
    bpy.ops.crowdface.import_faces()
    (whole,), (half,) = imported(0), imported(1)
    assert 0.4 < len(half.data.polygons) / len(whole.data.polygons) < 0.6
    assert whole.visible_get() and not half.visible_get()
    browse.all_levels = False
    places = set(map(tuple, points(whole)))
    clear()
    browse.weld = True
    bpy.ops.crowdface.import_faces()
    (welded,) = imported()
    assert set(map(tuple, points(welded))) == places
    assert len(welded.data.vertices) == len(places) == len(bpy.data.objects[HEADS[0]].data.vertices)
    assert [key.name for key in welded.data.shape_keys.key_blocks] == ["Basis", "smile"]
    browse.weld = False
    clear()


def test_review(browse, crowd):
    choose(browse, ["mob_0001", "mob_0002"])
    bpy.ops.crowdface.import_faces()
    before = {item[faces.FACE]: (points(item), tuple(item.location)) for item in imported()}
    fails(bpy.ops.crowdface.review, "mark at least one face")
    browse.faces["mob_0002"].mark = 'reject'
    bpy.ops.crowdface.review()
    after = {item[faces.FACE]: (points(item), tuple(item.location)) for item in imported()}
    assert numpy.array_equal(before["mob_0001"][0], after["mob_0001"][0])
    assert not numpy.array_equal(before["mob_0002"][0], after["mob_0002"][0]), "drawn again"
    assert before["mob_0002"][1] == after["mob_0002"][1], "at the same place"
    assert [item.mark for item in browse.faces] == ['NONE'] * 6
    clear()


def test_changes(browse):
    """A variant and, in the crowd of heads with tags of age, an older face."""
    browse.faces["mob_0003"].mark = 'variant'
    fails(bpy.ops.crowdface.review, "mob_0003: choose the face that it is a variant of")
    browse.faces["mob_0003"].variant_of, browse.faces["mob_0003"].distance = "mob_0001", 1.5
    bpy.ops.crowdface.review()
    variant, like = (read_plan("mob")[face] for face in ("mob_0003", "mob_0001"))
    assert variant["target"] == like["target"], "a variant has the target of its face"
    browse.faces["mob_0001"].mark, browse.faces["mob_0002"].mark = 'older', 'younger'
    bpy.ops.crowdface.review()
    plan = read_plan("mob")
    assert plan["mob_0001"]["age"] > 0 > plan["mob_0002"]["age"]


def read_plan(name):
    with open(os.path.join(folder, "made", "out", name, "plan.jsonl"), encoding="utf-8") as lines:
        return {face["id"]: face for face in map(json.loads, lines)}


def test_hair(browse):
    """A crowd that the program made: with hair, and at first without GLB files."""
    subprocess.run([program_path, "init", os.path.join(folder, "heads"), "-o", os.path.join(folder, "hair.yaml")],
                   check=True)
    subprocess.run([program_path, "generate", os.path.join(folder, "hair.yaml"), "--count", "2", "--out",
                    os.path.join(folder, "hair"), "--set", "output.meshes=[ply]"], check=True)
    browse.folder = os.path.join(folder, "hair")
    choose(browse, ["crowd_0001"])
    fails(bpy.ops.crowdface.import_faces, "has no GLB file of crowd_0001")
    bpy.ops.crowdface.add_glb()
    assert crowds.read(browse.path()).formats() == ["ply", "glb"]
    choose(browse, ["crowd_0001"])
    bpy.ops.crowdface.import_faces()
    (face,) = imported()
    assert any("hair" in slot.name for item in face.children for slot in item.data.materials), list(face.children)
    clear()


def test_wrap():
    """A scan of the second head: turned, other size, without the template's vertex order."""
    template, other = bpy.data.objects[HEADS[2]], bpy.data.objects[HEADS[1]]
    scan = bpy.data.objects.new("scan", other.data.copy())
    scene.collection.objects.link(scan)
    order = numpy.random.default_rng(1).permutation(len(other.data.vertices))
    scan.data = shuffled(other.data, order)
    turn = other.matrix_world.to_3x3().to_4x4()
    scan.matrix_world = Matrix.Translation((4, 0, 0)) @ Matrix.Rotation(0.3, 4, 'Z') @ turn
    numbers = {"nose": front_vertex(template), **{f"p{n}": n for n in range(100, 4000, 400)}}
    bpy.context.view_layer.update()
    for item, number_of in ((template, lambda n: n), (scan, lambda n: int(numpy.argsort(order)[n]))):
        for name, number in numbers.items():
            empty = bpy.data.objects.new(name, None)
            scene.collection.objects.link(empty)
            empty.parent = item
            empty.location = item.data.vertices[number_of(number)].co
    bpy.context.view_layer.update()
    bpy.context.view_layer.objects.active = template
    scene.crowdface.wrap.scan = scan
    bpy.ops.crowdface.wrap()
    wrapped = bpy.data.objects["scan wrapped"]
    assert [tuple(p.vertices) for p in wrapped.data.polygons] == [tuple(p.vertices) for p in template.data.polygons]
    off = aligned_distance(meshes.points_of(wrapped), meshes.points_of(other))
    apart = aligned_distance(meshes.points_of(template), meshes.points_of(other))
    assert off < 0.0015 and off < 0.5 * apart, (off, apart)


def front_vertex(item):
    return int(meshes.points_of(item)[:, 1].argmin())


def shuffled(mesh, order):
    """The same surface with vertex i at the place of vertex order[i]."""
    to = numpy.argsort(order)
    new = bpy.data.meshes.new("scan")
    polygons = [[int(to[v]) for v in polygon.vertices] for polygon in mesh.polygons]
    new.from_pydata([mesh.vertices[i].co[:] for i in order], [], polygons)
    return new


def aligned_distance(a, b):
    """Root mean square after rotation, translation and scale."""
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    a, b = a / numpy.linalg.norm(a) * numpy.linalg.norm(b), b
    u, _, v = numpy.linalg.svd(a.T @ b)
    return numpy.sqrt(((a @ (u @ v) - b) ** 2).sum(axis=1).mean())


def test_cancel(options):
    """A cancelled run ends with the program's exit code for an interruption; the next run makes the rest."""
    options.count = 60
    from crowdface_blender.generate import Crowd
    crowd = Crowd(options)
    job = program.Job("Generate", [crowd.command("generate")], crowd.out)
    while job.running() and job.fraction < 0.2:
        time.sleep(0.05)
    assert "of 62 faces" in job.message, job.message
    job.cancel()
    while job.running():
        time.sleep(0.05)
    assert job._process.returncode == 75, job.output()
    bpy.ops.crowdface.generate()
    assert len(crowds.read(crowd.out).faces) == len(imported()) == 62
    clear()
    options.count = 4


scene = bpy.context.scene
empty_scene()
options, browse = scene.crowdface.generate, scene.crowdface.browse
options.heads = import_heads()
options.folder = os.path.join(folder, "made")
options.count, options.families, options.members, options.groups = 4, 1, 2, True
options.distance = 0.3  # so that the few heads also have the 60 faces of the last test
options.expressions = bpy.data.objects[HEADS[0]]
options.lods, options.traits = "50 %", "nose_width"
test_check(options)
print("test: heads are written in order, and another topology is refused")
crowd = test_generate(options)
print("test: a crowd with a family, groups, shape keys and textures is made and shown")
test_filters(browse, crowd)
plane = test_places(browse)
test_instances(browse, plane, crowd)
test_levels(browse)
print("test: faces are filtered and placed, with levels of detail")
test_review(browse, crowd)
print("test: a review draws rejected faces again")
test_changes(browse)
print("test: faces become variants, older and younger")
test_cancel(options)
print("test: a cancelled run continues")
test_hair(browse)
print("test: a crowd without GLB files gets them, and hair is imported")
test_wrap()
print("test: a template is wrapped onto a scan")
bpy.ops.preferences.addon_disable(module="crowdface_blender")
