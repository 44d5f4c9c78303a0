// SPDX-License-Identifier: Apache-2.0
// Heads as arrays: reading, smoothing, blending, distances.
#include <filesystem>
#include <utility>

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "crowdface/blend/blend.h"
#include "crowdface/cast/face_distances.h"
#include "crowdface/config/input_files.h"
#include "crowdface/core/file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/units.h"
#include "crowdface/crowd/plan_file.h"
#include "crowdface/heads/load_inputs.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/smooth/chebyshev_filter.h"

#include "bindings/bindings.h"
#include "bindings/long_call.h"

namespace crowdface::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

using Numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

struct Polygons {
  std::vector<std::uint32_t> corners, offsets = {0};
};

/// A view of numbers that `owner` keeps alive. Not writable.
template <class Number>
py::array view(const std::vector<Number>& numbers, const py::object& owner) {
  py::array_t<Number> array({static_cast<py::ssize_t>(numbers.size())}, numbers.data(), owner);
  array.attr("setflags")(false);
  return array;
}

/// An index below `count`; -1 and kNoIndex mean none.
std::uint32_t index_from(std::int64_t number, Index count, bool may_be_missing,
                         const std::string& what) {
  if (may_be_missing && (number == -1 || number == kNoIndex)) return kNoIndex;
  if (number < 0 || number >= count) {
    throw InvalidInput(
        concat(what, ": expected numbers from 0 to ", count - 1, ", found ", number));
  }
  return static_cast<std::uint32_t>(number);
}

/// Reads polygons from an array (F, k), from (corners, offsets), or from a list of lists.
Polygons polygons_from(const py::object& faces, Index count, bool may_be_missing,
                       const std::string& what) {
  Polygons result;
  const auto add = [&](std::int64_t number) {
    result.corners.push_back(index_from(number, count, may_be_missing, what));
  };
  if (py::isinstance<py::array>(faces)) {
    const Numbers rows = Numbers::ensure(faces);
    if (!rows || rows.ndim() != 2) throw InvalidInput(concat(what, ": expected an array (F, k)"));
    for (py::ssize_t i = 0; i < rows.size(); ++i) add(rows.data()[i]);
    for (py::ssize_t f = 1; f <= rows.shape(0); ++f) {
      result.offsets.push_back(static_cast<std::uint32_t>(f * rows.shape(1)));
    }
    return result;
  }
  if (py::isinstance<py::tuple>(faces) && py::len(faces) == 2) {
    const Numbers corners = Numbers::ensure(faces[py::int_(0)]);
    const Numbers offsets = Numbers::ensure(faces[py::int_(1)]);
    if (!corners || !offsets || offsets.size() == 0 || offsets.data()[0] != 0 ||
        offsets.data()[offsets.size() - 1] != corners.size()) {
      throw InvalidInput(
          concat(what, ": expected corners, and offsets from 0 to the number of corners"));
    }
    for (py::ssize_t i = 0; i < corners.size(); ++i) add(corners.data()[i]);
    for (py::ssize_t f = 1; f < offsets.size(); ++f) {
      if (offsets.data()[f] < offsets.data()[f - 1]) {
        throw InvalidInput(concat(what, ": expected ascending offsets"));
      }
      result.offsets.push_back(static_cast<std::uint32_t>(offsets.data()[f]));
    }
    return result;
  }
  for (const py::handle polygon : faces) {
    for (const py::handle number : polygon) add(number.cast<std::int64_t>());
    result.offsets.push_back(static_cast<std::uint32_t>(result.corners.size()));
  }
  return result;
}

HeadSet heads_from_arrays(std::vector<Positions> positions, const py::object& faces,
                          const std::optional<TextureCoordinates>& uvs, const py::object& uv_faces,
                          std::optional<std::vector<std::string>> names) {
  if (positions.empty()) throw InvalidInput("positions: expected at least one head, found none");
  HeadSet set;
  const Index count = positions.front().rows();
  Polygons polygons = polygons_from(faces, count, false, "faces");
  set.topology.vertex_count = count;
  set.topology.corner_vertices = std::move(polygons.corners);
  set.topology.face_offsets = std::move(polygons.offsets);
  for (Index f = 0; f < set.topology.face_count(); ++f) {
    if (set.topology.face(f).size() < 3) {
      throw InvalidInput(concat("faces: polygon ", f, ": expected at least three corners, found ",
                                set.topology.face(f).size()));
    }
  }
  if (uvs) {
    set.uvs = *uvs;
    Polygons corners =
        polygons_from(uv_faces.is_none() ? faces : uv_faces, uvs->rows(), true, "uv_faces");
    if (corners.offsets != set.topology.face_offsets) {
      throw InvalidInput("uv_faces: expected as many corners as the faces have");
    }
    set.topology.corner_uvs = std::move(corners.corners);
  }
  if (names && names->size() != positions.size()) {
    throw InvalidInput(
        concat("names: expected ", positions.size(), " names, found ", names->size()));
  }
  for (std::size_t h = 0; h < positions.size(); ++h) {
    if (positions[h].rows() != count || !positions[h].allFinite()) {
      throw InvalidInput(concat("positions: head ", h, ": expected ", count,
                                " rows of finite numbers, found ", positions[h].rows(), " rows"));
    }
    const std::string number = std::to_string(h);
    set.heads.push_back(
        {names ? (*names)[h] : concat("head_", number.size() < 2 ? "0" : "", number),
         std::move(positions[h])});
  }
  return set;
}

HeadSet read_heads_from(const std::vector<fs::path>& files) {
  Config::Faces faces;
  for (const fs::path& file : files) {
    const std::vector<fs::path> found = is_folder(file) ? list_heads(file) : std::vector{file};
    faces.files.insert(faces.files.end(), found.begin(), found.end());
  }
  if (faces.files.empty()) throw MissingInput("heads: expected at least one file, found none");
  faces.names = names_of_heads(faces.files);
  Problems problems;
  std::optional<HeadSet> heads = load_head_set(faces, {}, problems);
  problems.throw_if_any();
  return std::move(*heads);
}

void save(const HeadSet& heads, const fs::path& folder) {
  make_directories(folder);
  for (const Head& head : heads.heads) {
    encode_obj({heads.topology, head.positions, heads.uvs}, {})
        .write(folder / concat(head.name, ".obj"));
  }
}

/// The faces as an array (F, k) if all have k corners; otherwise None.
py::object face_array(const py::object& self) {
  const Topology& topology = self.cast<const HeadSet&>().topology;
  const std::size_t corners = topology.face_count() > 0 ? topology.face(0).size() : 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    if (topology.face(f).size() != corners) return py::none();
  }
  return view(topology.corner_vertices, self)
      .reshape(
          {static_cast<py::ssize_t>(topology.face_count()), static_cast<py::ssize_t>(corners)});
}

/// The operator of a topology, prepared for any number of meshes.
class Smoothing {
 public:
  Smoothing(HeadSet heads, const std::string& boundary, const std::string& kind)
      : heads_(std::move(heads)),
        filter_(SmoothingOperator(
                    build_adjacency(heads_.topology),
                    value_of<Boundary>({{"fixed", Boundary::kFixed}, {"free", Boundary::kFree}},
                                       "boundary", boundary),
                    value_of<OperatorKind>(
                        {{"umbrella", OperatorKind::kUmbrella}, {"lazy", OperatorKind::kLazy}},
                        "operator", kind)),
                heads_.heads.front().positions) {}

  Index vertex_count() const { return filter_.vertex_count(); }

  std::vector<Positions> smoothed(const Eigen::Ref<const Positions>& positions,
                                  const std::vector<std::uint64_t>& levels) const {
    return smooth(filter_, positions, levels);
  }

  Positions blended(const std::string& recipe, const std::vector<std::string>& regions,
                    std::optional<RegionWeights::Alpha> masks) const {
    PlanNames names;
    for (const Head& head : heads_.heads) names.heads.push_back(head.name);
    names.regions = regions;
    const FacePlan face = parse_plan_line(recipe, names, "recipe").face;
    RegionWeights weights = whole_head_weights(heads_.topology);
    if (masks) weights.alpha = std::move(*masks);
    if (weights.alpha.rows() != filter_.vertex_count() ||
        static_cast<std::size_t>(weights.alpha.cols()) != regions.size()) {
      throw InvalidInput(concat("masks: expected an array of ", filter_.vertex_count(), " by ",
                                regions.size(), " (vertices by regions of the recipe), found ",
                                weights.alpha.rows(), " by ", weights.alpha.cols()));
    }
    return blend_exact(heads_, filter_, weights, face.recipe);
  }

 private:
  HeadSet heads_;
  ChebyshevFilter filter_;
};

Eigen::MatrixXd distances(const HeadSet& heads,
                          const std::vector<Eigen::Map<const Positions>>& faces,
                          const std::string& area, const std::string& front,
                          const std::string& unit) {
  const auto axis = parse_axis(front);
  if (!axis) throw UsageError(concat("front: expected an axis such as +Z, found ", quoted(front)));
  const auto length = parse_length_unit(unit);
  if (!length) throw UsageError(concat("unit: expected a unit such as cm, found ", quoted(unit)));
  const std::vector<double> areas = compared_vertex_areas(
      heads.topology, find_components(build_adjacency(heads.topology)), mean_head(heads),
      value_of<ComparedArea>({{"front", ComparedArea::kFront}, {"skin", ComparedArea::kSkin}},
                             "area", area),
      *axis);
  return face_distances(faces, areas) * mm_per(*length);
}

/// The result of a long call.
template <class Work>
auto result_of(const Work& work) {
  std::optional<decltype(work())> result;
  long_call(py::none(), [&] { result.emplace(work()); });
  return std::move(*result);
}

}  // namespace

void bind_heads(py::module_& module) {
  py::class_<HeadSet>(module, "Heads")
      .def(py::init(&heads_from_arrays), py::arg("positions"), py::arg("faces"), py::kw_only(),
           py::arg("uvs") = py::none(), py::arg("uv_faces") = py::none(),
           py::arg("names") = py::none())
      .def("__len__", [](const HeadSet& heads) { return heads.heads.size(); })
      .def_property_readonly("names",
                             [](const HeadSet& heads) {
                               std::vector<std::string> names;
                               for (const Head& head : heads.heads) names.push_back(head.name);
                               return names;
                             })
      .def_property_readonly("vertex_count",
                             [](const HeadSet& heads) { return heads.topology.vertex_count; })
      .def(
          "positions",
          [](const HeadSet& heads, std::size_t head) -> const Positions& {
            if (head >= heads.heads.size()) throw py::index_error("no such head");
            return heads.heads[head].positions;
          },
          py::arg("head"), py::return_value_policy::reference_internal)
      .def_property_readonly(
          "uvs", [](const HeadSet& heads) -> const TextureCoordinates& { return heads.uvs; },
          py::return_value_policy::reference_internal)
      .def_property_readonly("corners",
                             [](const py::object& self) {
                               return view(self.cast<const HeadSet&>().topology.corner_vertices,
                                           self);
                             })
      .def_property_readonly("uv_corners",
                             [](const py::object& self) {
                               return view(self.cast<const HeadSet&>().topology.corner_uvs, self);
                             })
      .def_property_readonly("offsets",
                             [](const py::object& self) {
                               return view(self.cast<const HeadSet&>().topology.face_offsets, self);
                             })
      .def_property_readonly("faces", face_array)
      .def("mean", &mean_head, py::call_guard<py::gil_scoped_release>())
      .def("save", &save, py::arg("folder"), py::call_guard<py::gil_scoped_release>());

  module.def(
      "read_heads",
      [](const std::vector<fs::path>& files, const py::object& progress) {
        std::optional<HeadSet> heads;
        long_call(progress, [&] { heads = read_heads_from(files); });
        return std::move(*heads);
      },
      py::arg("files"), py::arg("progress"));

  py::class_<Smoothing>(module, "Smoothing")
      .def(py::init([](const HeadSet& heads, const std::string& boundary, const std::string& kind) {
             std::unique_ptr<Smoothing> made;
             long_call(py::none(),
                       [&] { made = std::make_unique<Smoothing>(heads, boundary, kind); });
             return made;
           }),
           py::arg("heads"), py::arg("boundary"), py::arg("operator"))
      .def(
          "smooth",
          [](const Smoothing& smoothing, const PositionsArray& positions,
             const std::vector<std::uint64_t>& iterations) {
            const auto rows = rows_of(positions, smoothing.vertex_count(), "positions");
            return result_of([&] { return smoothing.smoothed(rows, iterations); });
          },
          py::arg("positions"), py::arg("iterations"))
      .def(
          "blend",
          [](const Smoothing& smoothing, const std::string& recipe,
             const std::vector<std::string>& regions, std::optional<RegionWeights::Alpha> masks) {
            return result_of([&] { return smoothing.blended(recipe, regions, std::move(masks)); });
          },
          py::arg("recipe"), py::arg("regions"), py::arg("masks"));

  module.def(
      "distances",
      [](const HeadSet& heads, const std::vector<PositionsArray>& faces, const std::string& area,
         const std::string& front, const std::string& unit) {
        std::vector<Eigen::Map<const Positions>> rows;
        for (const PositionsArray& face : faces) {
          rows.push_back(rows_of(face, heads.topology.vertex_count, "faces"));
        }
        return result_of([&] { return distances(heads, rows, area, front, unit); });
      },
      py::arg("heads"), py::arg("faces"), py::arg("area"), py::arg("front"), py::arg("unit"));
}

}  // namespace crowdface::python
