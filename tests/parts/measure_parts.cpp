// SPDX-License-Identifier: Apache-2.0
// How eyes and teeth sit in heads and in crowds made of them: distances between lids and eyeballs,
// what of them passes through the other, teeth and gums that pass through lips or cheeks. A table
// in Markdown, a column for the heads and one for each crowd. Heads look along +z, +y is up, in cm.
//   crowdface_measure_parts HEADS_FOLDER CROWD_FOLDER…
//   crowdface_measure_parts --bands HEADS_FOLDER PREFIX
//       paints a mask in three bands to PREFIX.1001.png and so on
//   crowdface_measure_parts --follow HEADS_FOLDER CROWD_FOLDER
//       of a crowd with `parts: none`: lets the parts follow here, and times it
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/paint/mask_bands.h"
#include "crowdface/parts/follower.h"
#include "crowdface/parts/part_list.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/surface_point.h"
#include "crowdface/region/mask_painting.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;

/// Vertices of the skin to be watched beside an eyeball.
struct Eye {
  const Part* part;
  std::vector<std::uint32_t> rim;
  std::vector<bool> upper;            ///< #rim
  std::vector<std::uint32_t> around;  ///< lids and what lines them
};

/// Signed distances of one mesh, in millimetres: #eyes by #rim, #mouths by #vertices.
struct Reading {
  std::vector<std::vector<double>> lids;    ///< of the rim; negative: inside the eyeball
  std::vector<std::vector<double>> around;  ///< of all skin near the eyeball
  std::vector<std::vector<double>> mouth;   ///< negative: inside the flesh
  /// Whether what is nearest is a wall of the mouth; roots reach through its roof and floor, where
  /// nobody sees them.
  std::vector<std::vector<bool>> wall;
  std::vector<double> gums;  ///< distances between gums and the teeth in them
};

class Watch {
 public:
  explicit Watch(const HeadSet& head_set) : topology_(head_set.topology), around_(topology_) {
    mean_ = Positions::Zero(topology_.vertex_count, 3);
    for (const Head& head : head_set.heads) mean_ += head.positions;
    mean_ /= static_cast<double>(head_set.heads.size());
    const Adjacency adjacency = build_adjacency(topology_);
    const Components components = find_components(adjacency);
    parts_ = find_parts(topology_, adjacency, components, mean_);
    component_ = components.component_of_vertex;
    for (std::uint32_t v = 0; v < topology_.vertex_count; ++v) {
      is_skin_.push_back(parts_.classes[components.component_of_vertex[v]] == PartClass::kSkin);
      if (is_skin_.back()) skin_.push_back(v);
    }
    for (const Part& part : parts_.parts) {
      if (part.part_class != PartClass::kRigid) continue;
      if (part.is_eyeball) {
        eyes_.push_back(watch_eye(part));
      } else {
        mouths_.push_back(&part);
        const PointGrid teeth(mean_, part.vertices);
        for (const Part& other : parts_.parts) {
          if (other.part_class != PartClass::kBound) continue;
          for (const std::uint32_t v : other.vertices) {
            const auto nearest = teeth.nearest(mean_.row(v).transpose(), 1 / kMm);
            if (nearest.vertex != kNoIndex) gums_.emplace_back(v, nearest.vertex);
          }
        }
      }
    }
  }

  Reading read(const Positions& mesh) const {
    Reading reading;
    for (const Eye& eye : eyes_) {
      // Of the layers of an eyeball the outermost.
      const PointGrid ball(mesh, eye.part->ball_vertices);
      const Vector3d centre = middle_of(mesh, eye.part->ball_vertices);
      const auto gaps = [&](const std::vector<std::uint32_t>& vertices) {
        std::vector<double> result;
        for (const std::uint32_t v : vertices) {
          const Vector3d point = mesh.row(v).transpose();
          const SurfacePoint place =
              nearest_point_around(topology_, around_, mesh, ball.nearest(point).vertex, point);
          Vector3d outward = normal_at(mesh, place);
          if (outward.dot(place.position - centre) < 0) outward = -outward;
          const double side = outward.dot(point - place.position) < 0 ? -1 : 1;
          result.push_back(side * place.distance * kMm);
        }
        return result;
      };
      reading.lids.push_back(gaps(eye.rim));
      reading.around.push_back(gaps(eye.around));
    }
    for (const auto& [gum, tooth] : gums_) {
      reading.gums.push_back((mesh.row(gum) - mesh.row(tooth)).norm() * kMm);
    }
    const PointGrid skin(mesh, skin_);
    const Positions normals = vertex_normals(topology_, mesh);
    for (const Part* part : mouths_) {
      std::vector<double> depths;
      std::vector<bool> walls;
      for (const std::uint32_t v : part->vertices) {
        const Vector3d point = mesh.row(v).transpose();
        const SurfacePoint place =
            nearest_point_around(topology_, around_, mesh, skin.nearest(point).vertex, point);
        Vector3d normal = Vector3d::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
          normal += place.barycentric[k] * normals.row(place.corners[k]).transpose();
        }
        // Where lips lie in folds the nearest skin may look away from the flesh: the turns tell.
        const bool inside =
            normal.dot(point - place.position) < 0 && turns_around(mesh, point) > 0.5;
        depths.push_back((inside ? -1 : 1) * place.distance * kMm);
        walls.push_back(std::abs(normal.y()) < 0.7 * normal.norm());
      }
      reading.mouth.push_back(std::move(depths));
      reading.wall.push_back(std::move(walls));
    }
    return reading;
  }

  std::size_t gums() const { return gums_.size(); }
  const std::vector<Eye>& eyes() const { return eyes_; }
  const PartList& parts() const { return parts_; }
  /// Of the mouth's vertices: whether it is of a closed piece.
  bool is_tooth(std::size_t mouth, std::size_t i) const {
    return parts_.shapes[component_[mouths_[mouth]->vertices[i]]].isoperimetric_ratio == 0;
  }

 private:
  static Vector3d middle_of(const Positions& mesh, const std::vector<std::uint32_t>& vertices) {
    Vector3d low = mesh.row(vertices[0]).transpose(), high = low;
    for (const std::uint32_t v : vertices) {
      low = low.cwiseMin(mesh.row(v).transpose());
      high = high.cwiseMax(mesh.row(v).transpose());
    }
    return (low + high) / 2;
  }

  /// How often the skin winds around a point: 1 inside, 0 outside, about, since the neck is open
  /// (the solid angles of its triangles, Van Oosterom & Strackee 1983).
  double turns_around(const Positions& mesh, const Vector3d& point) const {
    double sum = 0;
    for (Index f = 0; f < topology_.face_count(); ++f) {
      const auto face = topology_.face(f);
      if (!is_skin_[face[0]]) continue;
      const Vector3d a = mesh.row(face[0]).transpose() - point;
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        const Vector3d b = mesh.row(face[k]).transpose() - point;
        const Vector3d c = mesh.row(face[k + 1]).transpose() - point;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
      }
    }
    return sum / 6.2831853071795865;
  }

  /// The rim of the lids on the mean head: every 6° around the axis the skin that is innermost; and
  /// all other skin near the eyeball's front, for what passes through it.
  Eye watch_eye(const Part& part) const {
    constexpr int kSectors = 60;
    constexpr double kNear = 0.35;  // cm
    Eye eye{&part, {}, {}, {}};
    const PointGrid ball(mean_, part.ball_vertices);
    const Vector3d centre = middle_of(mean_, part.ball_vertices);
    std::vector<double> nearest(kSectors, 0.4);
    std::vector<std::uint32_t> rim(kSectors, kNoIndex);
    for (const std::uint32_t v : skin_) {
      const Vector3d from = mean_.row(v).transpose() - centre;
      if (from.z() < 0 || ball.nearest(mean_.row(v).transpose(), kNear).vertex == kNoIndex)
        continue;
      eye.around.push_back(v);
      const double turn = std::atan2(from.y(), from.x()) / 6.2831853071795865 + 0.5;
      const auto sector = std::min(kSectors - 1, static_cast<int>(turn * kSectors));
      const auto i = static_cast<std::size_t>(sector);
      if (from.normalized().z() <= nearest[i]) continue;
      nearest[i] = from.normalized().z();
      rim[i] = v;
    }
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    for (const std::uint32_t v : rim) {
      if (v == kNoIndex) continue;
      eye.rim.push_back(v);
      eye.upper.push_back(mean_(v, 1) > centre.y());
    }
    return eye;
  }

  static constexpr double kMm = 10;  // in a unit
  const Topology& topology_;
  VertexFaces around_;
  Positions mean_;
  PartList parts_;
  std::vector<std::uint32_t> component_;  ///< #V
  std::vector<bool> is_skin_;             ///< #V
  std::vector<std::uint32_t> skin_;
  std::vector<Eye> eyes_;
  std::vector<const Part*> mouths_;
  /// Bound vertices less than a millimetre from a tooth on the mean head, and its nearest vertex.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> gums_;
};

struct Range2 {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  std::string text() const { return concat(format_fixed(low, 2), " … ", format_fixed(high, 2)); }
};

double mean_gap(const Eye& eye, const std::vector<double>& gaps, bool upper) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (eye.upper[i] != upper) continue;
    sum += gaps[i];
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

/// The least value of each row over the heads.
std::vector<std::vector<double>> least(const std::vector<Reading>& heads,
                                       std::vector<std::vector<double>> Reading::*member) {
  auto result = heads[0].*member;
  for (const Reading& head : heads) {
    for (std::size_t p = 0; p < result.size(); ++p) {
      for (std::size_t i = 0; i < result[p].size(); ++i) {
        result[p][i] = std::min(result[p][i], (head.*member)[p][i]);
      }
    }
  }
  return result;
}

/// What the table says of one set of meshes.
struct Through {
  Range2 vertices, deepest;  ///< of a mesh: how many are inside the other, and how deep
  int fresh = 0, faces = 0;  ///< where no input is inside: vertices of all meshes, and such meshes
  double fresh_mm = 0;       ///< the deepest of them
};

struct Column {
  std::string name;
  Range2 upper, lower, nearest;       ///< mean gaps of a lid; the smallest gap of a mesh
  Range2 upper_change, lower_change;  ///< of the mean gaps against the target's
  Range2 rim_change;                  ///< of single gaps
  Range2 gum_change;                  ///< of the distances between gums and teeth
  Through rim, eye, teeth, gums;
};

constexpr double kThrough = 0.02;  // mm; shallower is rounding

/// Counts what lies inside the other; `counts` says of each vertex whether it is looked at.
template <class Counts>
void add(Through& through, const std::vector<std::vector<double>>& distances,
         const std::vector<std::vector<double>>& least, const Counts& counts) {
  int inside = 0, fresh = 0;
  double deepest = 0;
  for (std::size_t p = 0; p < distances.size(); ++p) {
    for (std::size_t i = 0; i < distances[p].size(); ++i) {
      const double depth = -distances[p][i];
      if (depth <= kThrough || !counts(p, i)) continue;
      ++inside;
      deepest = std::max(deepest, depth);
      if (least[p][i] < -kThrough) continue;
      ++fresh;
      through.fresh_mm = std::max(through.fresh_mm, depth);
    }
  }
  through.vertices.add(inside);
  through.deepest.add(deepest);
  through.fresh += fresh;
  through.faces += fresh > 0 ? 1 : 0;
}

struct Least {
  std::vector<std::vector<double>> lids, around, mouth;
};

void add(Column& column, const Watch& watch, const Reading& reading, const Reading& target,
         const Least& least) {
  for (std::size_t e = 0; e < watch.eyes().size(); ++e) {
    const Eye& eye = watch.eyes()[e];
    const auto& gaps = reading.lids[e];
    const double up = mean_gap(eye, gaps, true), low = mean_gap(eye, gaps, false);
    column.upper.add(up);
    column.lower.add(low);
    column.upper_change.add(up - mean_gap(eye, target.lids[e], true));
    column.lower_change.add(low - mean_gap(eye, target.lids[e], false));
    for (const double gap : gaps) column.nearest.add(gap);
    for (std::size_t i = 0; i < gaps.size(); ++i)
      column.rim_change.add(gaps[i] - target.lids[e][i]);
  }
  add(column.rim, reading.lids, least.lids, [](std::size_t, std::size_t) { return true; });
  add(column.eye, reading.around, least.around, [](std::size_t, std::size_t) { return true; });
  for (std::size_t i = 0; i < watch.gums(); ++i) {
    column.gum_change.add(reading.gums[i] - target.gums[i]);
  }
  const auto tooth = [&](std::size_t p, std::size_t i) { return watch.is_tooth(p, i); };
  const auto wall = [&](std::size_t p, std::size_t i) { return reading.wall[p][i]; };
  add(column.teeth, reading.mouth, least.mouth,
      [&](std::size_t p, std::size_t i) { return wall(p, i) && tooth(p, i); });
  add(column.gums, reading.mouth, least.mouth,
      [&](std::size_t p, std::size_t i) { return wall(p, i) && !tooth(p, i); });
}

void print(const std::vector<Column>& columns) {
  const auto row = [&](const std::string& name, const auto& value) {
    std::cout << "| " << name << " |";
    for (const Column& column : columns) std::cout << ' ' << value(column) << " |";
    std::cout << '\n';
  };
  const auto through = [&](const std::string& name, Through Column::*member) {
    row(concat(name, ", a face"), [&](const Column& c) {
      const Range2& vertices = (c.*member).vertices;
      return concat(vertices.low, " … ", vertices.high);
    });
    row("– the deepest of a face, mm", [&](const Column& c) { return (c.*member).deepest.text(); });
    row("– where no input head has one, all faces", [&](const Column& c) {
      const Through& t = c.*member;
      return t.fresh == 0 ? std::string("none")
                          : concat(t.fresh, " in ", t.faces, " faces, up to ",
                                   format_fixed(t.fresh_mm, 2), " mm");
    });
  };
  row("", [](const Column& c) { return c.name; });
  row("---", [](const Column&) { return "---"; });
  row("mean gap of the upper lid's rim, mm", [](const Column& c) { return c.upper.text(); });
  row("mean gap of the lower lid's rim, mm", [](const Column& c) { return c.lower.text(); });
  row("gaps of single vertices of the rim, mm", [](const Column& c) { return c.nearest.text(); });
  row("mean gap against the target's, upper, mm",
      [](const Column& c) { return c.upper_change.text(); });
  row("mean gap against the target's, lower, mm",
      [](const Column& c) { return c.lower_change.text(); });
  row("single gaps against the target's, mm", [](const Column& c) { return c.rim_change.text(); });
  through("vertices of the rim inside an eyeball", &Column::rim);
  through("vertices of lids and their lining inside an eyeball", &Column::eye);
  through("vertices of teeth in lips or cheeks", &Column::teeth);
  through("vertices of gums and tongue in lips or cheeks", &Column::gums);
  row("gums against their teeth, change of distance, mm",
      [](const Column& c) { return c.gum_change.text(); });
}

HeadSet read_heads(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  HeadSet faces;
  for (const std::filesystem::path& file : files) {
    ObjFile obj = read_obj(file);
    faces.topology = std::move(obj.topology);
    faces.uvs = std::move(obj.uvs);
    faces.heads.push_back({file.stem().string(), std::move(obj.positions)});
  }
  return faces;
}

/// A face of a crowd: its file, and the head it was built on.
struct Face {
  std::filesystem::path file;
  std::size_t target = 0;
};

std::vector<Face> read_plan(const std::filesystem::path& crowd, const HeadSet& head_set) {
  const auto value = [](const std::string& line, const std::string& key) {
    const std::string opening = concat('"', key, "\":\"");
    const std::size_t begin = line.find(opening) + opening.size();
    return line.substr(begin, line.find('"', begin) - begin);
  };
  std::vector<Face> result;
  std::ifstream plan(crowd / "plan.jsonl");
  for (std::string line; std::getline(plan, line);) {
    Face face{crowd / "meshes" / concat(value(line, "id"), ".obj"), 0};
    while (head_set.heads[face.target].name != value(line, "target")) ++face.target;
    result.push_back(face);
  }
  return result;
}

/// Bands by the heights of eyes and teeth.
void paint_bands(const std::filesystem::path& folder, const std::string& prefix) {
  constexpr int kSize = 512;
  HeadSet faces = read_heads(folder);
  const Watch watch(faces);
  const auto height_of = [&](bool eyeball) {
    double sum = 0, count = 0;
    for (const Part& part : watch.parts().parts) {
      if (part.part_class != PartClass::kRigid || part.is_eyeball != eyeball) continue;
      for (const std::uint32_t v : part.vertices) sum += faces.heads[0].positions(v, 1);
      count += static_cast<double>(part.vertices.size());
    }
    return sum / count;
  };
  const auto bands =
      horizontal_bands(faces.heads[0].positions.col(1), height_of(true), height_of(false));
  const PaintedMasks masks = paint_masks(faces.topology, faces.uvs, bands, {}, kSize);
  for (const auto& [file, bytes] : encode_masks(masks, prefix + ".png").png_files) {
    write_file(file, bytes);
  }
}

void measure(const std::filesystem::path& folder, const std::vector<std::string>& crowds,
             bool follow) {
  const HeadSet faces = read_heads(folder);
  const Watch watch(faces);
  std::vector<Reading> heads;
  for (const Head& head : faces.heads) heads.push_back(watch.read(head.positions));
  const Least smallest = {least(heads, &Reading::lids), least(heads, &Reading::around),
                          least(heads, &Reading::mouth)};
  std::vector<Column> columns(1);
  columns[0].name = "input heads";
  for (const Reading& head : heads) add(columns[0], watch, head, head, smallest);

  const std::clock_t start = std::clock();  // of this program alone: the machine may be busy
  const PartFollower follower(faces, watch.parts(), {});
  const std::clock_t making = std::clock() - start;
  std::clock_t following = 0;
  for (const std::string& crowd : crowds) {
    columns.emplace_back().name = std::filesystem::path(crowd).filename().string();
    if (follow) columns.emplace_back().name = "followed";
    for (const Face& face : read_plan(crowd, faces)) {
      Positions mesh = read_obj(face.file).positions;
      const auto read = [&](Column& column) {
        add(column, watch, watch.read(mesh), heads[face.target], smallest);
      };
      read(columns[columns.size() - (follow ? 2 : 1)]);
      if (!follow) continue;
      const std::clock_t begin = std::clock();
      follower.move_parts(static_cast<Index>(face.target), mesh);
      following += std::clock() - begin;
      read(columns.back());
    }
  }
  print(columns);
  constexpr double kMs = 1e3 / CLOCKS_PER_SEC;
  if (follow) {
    std::cout << concat("\n", static_cast<double>(making) * kMs, " ms to bind, ",
                        static_cast<double>(following) * kMs, " ms to follow\n");
  }
}

}  // namespace
}  // namespace crowdface

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool bands = !words.empty() && words[0] == "--bands";
  const bool follow = !words.empty() && words[0] == "--follow";
  if (follow || bands) words.erase(words.begin());
  if (words.size() < 2) {
    std::cerr << "usage: crowdface_measure_parts [--follow] HEADS_FOLDER CROWD_FOLDER…\n"
                 "       crowdface_measure_parts --bands HEADS_FOLDER PREFIX\n";
    return 64;
  }
  try {
    if (bands) {
      crowdface::paint_bands(words[0], words[1]);
      return 0;
    }
    crowdface::measure(words[0], {words.begin() + 1, words.end()}, follow);
    return 0;
  } catch (const crowdface::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
