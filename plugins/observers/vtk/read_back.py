"""Reads a folder of the vtk observer's test with VTK and compares it with what the test says is in it.

usage: read_back.py FOLDER: expected.json in FOLDER says what its files hold.
"""

import json
import pathlib
import sys
import xml.etree.ElementTree

import vtk


def read(path):
    failed = []
    reader = vtk.vtkXMLPolyDataReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: failed.append(event))
    reader.SetFileName(str(path))
    reader.Update()
    assert not failed, f"VTK complains about {path}"
    return reader.GetOutput()


def compare(what, found, expected, tolerance):
    found = [value for i in range(found.GetNumberOfTuples()) for value in found.GetTuple(i)]
    assert len(found) == len(expected), f"{what}: {len(found)} values, {len(expected)} expected"
    for a, b in zip(found, expected):
        assert abs(a - b) <= tolerance * abs(b), f"{what}: {a} read, {b} written"


def check_file(folder, expected):
    data = read(folder / expected["file"])
    compare("points", data.GetPoints().GetData(), expected["points"], expected["tolerance"])
    arrays = data.GetPointData()
    for name, values in expected["arrays"].items():
        assert arrays.HasArray(name), f"{expected['file']} has no array {name}"
        compare(name, arrays.GetArray(name), values, expected["tolerance"])
    assert data.GetNumberOfVerts() == data.GetNumberOfPoints()
    names = data.GetFieldData().GetAbstractArray("material_names")
    assert [names.GetValue(i) for i in range(names.GetNumberOfValues())] == expected["materials"]
    assert data.GetFieldData().GetArray("TimeValue").GetValue(0) == expected["time"]


def check_walls(folder, expected):
    data = read(folder / expected["file"])
    assert data.GetNumberOfPolys() == expected["triangles"], data.GetNumberOfPolys()
    volume = vtk.vtkMassProperties()
    volume.SetInputData(data)
    # vtkMassProperties sums in double, over corners that may be floats.
    assert abs(volume.GetVolume() - expected["volume"]) <= 1e-6 * expected["volume"], volume.GetVolume()


def main():
    folder = pathlib.Path(sys.argv[1])
    expected = json.loads((folder / "expected.json").read_text())
    for file in expected["files"]:
        check_file(folder, file)
    check_walls(folder, expected["walls"])
    collection = xml.etree.ElementTree.parse(folder / "run.pvd").getroot()
    listed = [(float(d.get("timestep")), int(d.get("part")), d.get("file")) for d in collection.iter("DataSet")]
    assert listed == [tuple(entry) for entry in expected["collection"]], listed
    for _, _, file in listed:
        assert (folder / file).is_file(), file


if __name__ == "__main__":
    main()
