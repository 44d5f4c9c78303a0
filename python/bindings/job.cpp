// SPDX-License-Identifier: Apache-2.0
// The jobs of a config: casting and blending in memory, and crowds in folders.
#include "crowdface/run/job.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "crowdface/config/config_reader.h"
#include "crowdface/core/file.h"
#include "crowdface/core/problems.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_table.h"
#include "crowdface/crowd/plan_file.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/heads/prepare.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/run/casting.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/planned.h"
#include "crowdface/run/wrap_scans.h"

#include "bindings/bindings.h"
#include "bindings/long_call.h"

namespace crowdface::python {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

/// The options of `plan`, `generate` and Job, from Python's keyword arguments.
struct Source {
  fs::path file;                    ///< the config; with a text, the name that it might have
  std::optional<std::string> text;  ///< the config's text, instead of a file
  ConfigOverrides overrides;
};

Config config_of(const Source& source) {
  Problems problems;
  ConfigReading reading =
      read_config_text(*source.text, fs::absolute(source.file), source.overrides, problems);
  problems.throw_if_any();
  return std::move(reading.config);
}

/// A job in memory. Prepares heads and makes builders when they are first needed.
class PythonJob {
 public:
  PythonJob(const Source& source, fs::path cache)
      : cache_(std::move(cache)),
        job_(source.text ? load_job(config_of(source), cache_)
                         : load_job(source.file, source.overrides, cache_)) {}

  const Job& job() const { return job_; }
  Index vertex_count() const { return job_.inputs.head_set.topology.vertex_count; }

  std::vector<std::string> cast() {
    std::vector<std::string> lines;
    const CrowdPlan plan = plan_crowd(
        job_.config, job_.inputs, prepared(), [this]() -> const FaceBuilder& { return builder(); },
        attachments_, cache_);
    std::string text;
    annotated_plan_text(plan.crowd, job_.names, job_.settings,
                        head_tags_and_attachment_kinds(job_.config))(
        [&](std::string_view piece) { text += piece; });
    for (const std::string_view line : split(text, '\n')) {
      if (!line.empty()) lines.emplace_back(line);
    }
    throw_if_truncated(prepared());
    return lines;
  }

  std::vector<Positions> blend(const std::vector<std::string>& recipes) {
    std::vector<FacePlan> faces;
    std::vector<const Recipe*> pointers;
    for (const std::string& recipe : recipes) faces.push_back(face_of(recipe));
    for (const FacePlan& face : faces) pointers.push_back(&face.recipe);
    std::vector<Positions> results(faces.size());
    builder().build(pointers, results);
    throw_if_truncated(prepared());
    return results;
  }

  // As for written faces, shapes and attachments belong to the rounded positions.
  std::vector<Displacements> shapes(const std::string& recipe,
                                    const Eigen::Ref<const Positions>& face) {
    if (!shapes_) shapes_.emplace(job_.config, job_.inputs);
    return shapes_->shapes_of_face(face_of(recipe).recipe, round_to_single(face));
  }

  std::vector<PlacedAttachment> attachments(const std::string& recipe,
                                            const Eigen::Ref<const Positions>& positions) {
    const FacePlan face = face_of(recipe);
    attachments_.bind({&face, 1});
    return attachments_.attachments_of(face, round_to_single(positions));
  }

 private:
  FacePlan face_of(const std::string& recipe) const {
    return parse_plan_line(recipe, job_.names, "recipe").face;
  }
  const PreparedHeads& prepared() {
    if (!prepared_) prepared_ = prepare(job_.config, job_.inputs, job_.smoothing, cache_);
    return *prepared_;
  }
  const FaceBuilder& builder() {
    if (!builder_) builder_.emplace(job_.config, job_.inputs, prepared());
    return *builder_;
  }

  fs::path cache_;
  Job job_;
  std::optional<PreparedHeads> prepared_;
  std::optional<FaceBuilder> builder_;
  std::optional<FaceShapes> shapes_;
  FaceAttachments attachments_{job_.config, job_.inputs};
};

py::dict dict_of(const CrowdCheck& check) {
  py::dict result;
  result["files"] = check.file_count;
  result["missing"] = check.missing_files;
  result["altered"] = check.altered_files;
  result["unfinished"] = check.unfinished_items;
  result["remarks"] = check.remarks;
  return result;
}

/// The options of a wrap from its arguments that are texts.
WrapOptions wrap_options(const std::map<std::string, std::string>& texts) {
  static const std::map<std::string, std::string WrapOptions::*> fields = {
      {"template", &WrapOptions::template_file},
      {"scan", &WrapOptions::scan},
      {"out", &WrapOptions::out},
      {"landmarks", &WrapOptions::landmarks},
      {"template_landmarks", &WrapOptions::template_landmarks},
      {"model", &WrapOptions::model},
      {"ignore", &WrapOptions::ignored_area_mask},
      {"units", &WrapOptions::units},
      {"scan_units", &WrapOptions::scan_units},
      {"up", &WrapOptions::up},
      {"front", &WrapOptions::front},
      {"scan_up", &WrapOptions::scan_up},
      {"scan_front", &WrapOptions::scan_front},
      {"texture", &WrapOptions::texture_size},
  };
  WrapOptions options;
  for (const auto& [name, text] : texts) options.*value_of(fields, "wrap", name) = text;
  return options;
}

/// Reads or casts a crowd into a folder. \return the folder.
fs::path run(const Source& source, GenerateOptions options, bool only_plan) {
  if (source.text) {
    const Config config = config_of(source);
    only_plan ? plan(config, options) : generate(config, options);
    return config.output.directory;
  }
  only_plan ? plan(source.file, source.overrides, options)
            : generate(source.file, source.overrides, options);
  Problems problems;
  const ConfigReading reading = read_partial_config(source.file, source.overrides, problems);
  return reading.config.output.directory;
}

}  // namespace

void bind_job(py::module_& module) {
  py::class_<Source>(module, "Source")
      .def(py::init([](fs::path file, std::optional<std::string> text, std::vector<std::string> set,
                       std::optional<std::string> out, std::vector<std::string> review,
                       bool without_reviews) {
             Source source{std::move(file), std::move(text), {}};
             source.overrides.assignments = std::move(set);
             source.overrides.out = std::move(out);
             source.overrides.review = std::move(review);
             source.overrides.without_reviews = without_reviews;
             return source;
           }),
           py::arg("file"), py::arg("text"), py::arg("set"), py::arg("out"), py::arg("review"),
           py::arg("without_reviews"));

  py::class_<PythonJob>(module, "Job")
      .def(py::init([](const Source& source, const fs::path& cache, const py::object& progress) {
             std::unique_ptr<PythonJob> job;
             long_call(progress, [&] { job = std::make_unique<PythonJob>(source, cache); });
             return job;
           }),
           py::arg("source"), py::arg("cache"), py::arg("progress"))
      .def_property_readonly(
          "heads", [](const PythonJob& job) -> const HeadSet& { return job.job().inputs.head_set; },
          py::return_value_policy::reference_internal)
      .def_property_readonly("regions",
                             [](const PythonJob& job) { return job.job().names.regions; })
      .def_property_readonly(
          "masks",
          [](const PythonJob& job) -> const RegionWeights::Alpha& {
            return job.job().inputs.regions.alpha;
          },
          py::return_value_policy::reference_internal)
      .def_property_readonly("warnings",
                             [](const PythonJob& job) { return job.job().inputs.warnings; })
      .def_property_readonly("shape_names",
                             [](const PythonJob& job) { return job.job().config.shapes.names; })
      .def(
          "cast",
          [](PythonJob& job, const py::object& progress) {
            std::vector<std::string> lines;
            long_call(progress, [&] { lines = job.cast(); });
            return lines;
          },
          py::arg("progress"))
      .def(
          "blend",
          [](PythonJob& job, const std::vector<std::string>& recipes, const py::object& progress) {
            std::vector<Positions> faces;
            long_call(progress, [&] { faces = job.blend(recipes); });
            return faces;
          },
          py::arg("recipes"), py::arg("progress"))
      .def(
          "shapes",
          [](PythonJob& job, const std::string& recipe, const PositionsArray& positions) {
            std::vector<Displacements> shapes;
            const auto rows = rows_of(positions, job.vertex_count(), "positions");
            long_call(py::none(), [&] { shapes = job.shapes(recipe, rows); });
            py::dict result;
            for (std::size_t i = 0; i < shapes.size(); ++i) {
              const auto count = static_cast<Index>(shapes[i].vertices.size());
              const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 1> vertices =
                  Eigen::Map<const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 1>>(
                      shapes[i].vertices.data(), count);
              result[py::str(job.job().config.shapes.names[i])] =
                  py::make_tuple(vertices, std::move(shapes[i].moves));
            }
            return result;
          },
          py::arg("recipe"), py::arg("positions"))
      .def(
          "attachments",
          [](PythonJob& job, const std::string& recipe, const PositionsArray& positions) {
            std::vector<PlacedAttachment> placed;
            const auto rows = rows_of(positions, job.vertex_count(), "positions");
            long_call(py::none(), [&] { placed = job.attachments(recipe, rows); });
            py::dict result;
            for (PlacedAttachment& one : placed) {
              result[py::str(one.item->name)] = py::cast(std::move(one.positions));
            }
            return result;
          },
          py::arg("recipe"), py::arg("positions"));

  module.def(
      "run",
      [](const Source& source, const fs::path& cache, bool force,
         const std::pair<std::uint64_t, std::uint64_t>& shard, std::uint64_t memory, bool only_plan,
         const py::object& progress) {
        GenerateOptions options;
        options.cache = cache;
        options.replace = force ? Replace::kForce : Replace::kRefuse;
        options.memory_bytes = memory;
        options.shard = {shard.first, shard.second};
        fs::path folder;
        long_call(progress, [&] { folder = run(source, options, only_plan); });
        return folder;
      },
      py::arg("source"), py::arg("cache"), py::arg("force"), py::arg("shard"), py::arg("memory"),
      py::arg("only_plan"), py::arg("progress"));
  module.def(
      "wrap",
      [](const std::map<std::string, std::string>& texts, bool picture, bool estimate, bool delight,
         bool strict, const py::object& progress) {
        WrapOptions options = wrap_options(texts);
        options.no_pictures = !picture;
        options.estimate = estimate;
        options.removes_shading = delight;
        options.strict = strict;
        long_call(progress, [&] { wrap_scans(options); });
      },
      py::arg("texts"), py::arg("picture"), py::arg("estimate"), py::arg("delight"),
      py::arg("strict"), py::arg("progress"));
  module.def(
      "gather",
      [](const fs::path& folder, const fs::path& cache, const py::object& progress) {
        long_call(progress, [&] { gather(folder, cache); });
      },
      py::arg("folder"), py::arg("cache"), py::arg("progress"));
  module.def(
      "verify",
      [](const fs::path& folder) {
        CrowdCheck check;
        long_call(py::none(), [&] { check = verify_crowd(folder); });
        return dict_of(check);
      },
      py::arg("folder"));
}

}  // namespace crowdface::python
