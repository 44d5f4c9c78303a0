// SPDX-License-Identifier: Apache-2.0
// How well `wrap` finds heads again: each becomes a scan, is wrapped by a template that does not know
// it, and is compared with its own vertices. scripts/measure_wrap.sh runs this.
//   crowdface_measure_wrap HEADS_DIR [HEAD …] [--templates one,mean,model]
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <string>
#include <vector>
#include <Eigen/Cholesky>

#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/validity/triangles.h"
#include "crowdface/wrap/wrap.h"

#include "wrap/truth_scan.h"

namespace {

namespace fs = std::filesystem;
using namespace crowdface;

/// Landmarks on the ICT face model: corners and middles of lids and lips, brows, nose, chin, ears.
const std::vector<WrapLandmark> kIctLandmarks = {
    {"chin", 966, {}},           {"nasion", 978, {}},         {"nose_tip", 4857, {}},
    {"subnasale", 1147, {}},     {"nostril_right", 1140, {}}, {"nostril_left", 3360, {}},
    {"eye_right_outer", 1507, {}}, {"eye_right_inner", 1528, {}}, {"eye_left_inner", 3742, {}},
    {"eye_left_outer", 3721, {}}, {"lid_right_upper", 1537, {}}, {"lid_left_upper", 3751, {}},
    {"lid_right_lower", 1518, {}}, {"lid_left_lower", 3732, {}}, {"mouth_right", 5708, {}},
    {"mouth_left", 6213, {}},    {"lip_upper", 0, {}},        {"lip_lower", 5518, {}},
    {"brow_right", 268, {}},     {"brow_left", 2509, {}},     {"lobe_left", 7125, {}},
    {"lobe_right", 7447, {}},    {"ear_left", 7238, {}},      {"ear_right", 7965, {}}};

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double distance_to_line(const Eigen::Vector3d& p, const std::vector<Eigen::Vector3d>& line) {
  double best = 1e300;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d a = line[i], d = line[(i + 1) % line.size()] - a;
    const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - a - t * d).norm());
  }
  return best;
}

/// Which of the measured regions each vertex of the head's skin belongs to.
struct Regions {
  std::vector<bool> skin, face, eyes, lips;
};

Regions regions_of(const WrapTemplate& head, const std::map<std::string, std::uint32_t>& marks) {
  const auto at = [&](const char* name) -> Eigen::Vector3d {
    return head.positions.row(marks.at(name)).transpose();
  };
  const Eigen::Vector3d middle = at("subnasale");
  const Eigen::Vector3d right = (at("eye_right_outer") + at("eye_right_inner")) / 2;
  const Eigen::Vector3d left = (at("eye_left_outer") + at("eye_left_inner")) / 2;
  const std::vector<Eigen::Vector3d> mouth = {at("mouth_right"), at("lip_upper"), at("mouth_left"),
                                              at("lip_lower")};
  Regions regions;
  for (std::size_t i = 0; i < head.skin.vertices.size(); ++i) {
    const Eigen::Vector3d p = head.positions.row(head.skin.vertices[i]).transpose();
    const bool seen = head.skin.openness[i] > 0.12;
    regions.skin.push_back(seen);
    regions.face.push_back(seen && (p - middle).norm() < 90);
    regions.eyes.push_back(seen && std::min((p - right).norm(), (p - left).norm()) < 22);
    regions.lips.push_back(seen && distance_to_line(p, mouth) < 6);
  }
  return regions;
}

struct Measured {
  std::vector<double> skin, face, eyes, lips, surface;
  Index flipped = 0;
  double seconds = 0;
};

void print_row(const std::string& name, const Measured& m) {
  std::printf("%-22s %5.2f /%5.2f  %5.2f /%5.2f  %5.2f  %5.2f  %5.2f  %4ld  %5.1f s\n", name.c_str(),
              percentile(m.skin, 0.5), percentile(m.skin, 0.95), percentile(m.face, 0.5),
              percentile(m.face, 0.95), percentile(m.eyes, 0.5), percentile(m.lips, 0.5),
              percentile(m.surface, 0.95), static_cast<long>(m.flipped), m.seconds);
  std::fflush(stdout);
}

void add(const std::vector<double>& from, std::vector<double>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

Measured measure(const WrapTemplate& shape, const ShapeModel* model, const WrapTemplate& head,
                 const test::TruthScan& truth, const Regions& regions) {
  const std::clock_t start = std::clock();
  WrapOptions options;
  const auto env=[](const char*n,double d){const char*e=std::getenv(n);return e?std::atof(e):d;};
  options.bend.steps=(int)env("STEPS",options.bend.steps);
  options.bend.tangential_first=env("TANG1",options.bend.tangential_first);
  options.bend.tangential_last=env("TANG2",options.bend.tangential_last);
  options.bend.backward=env("BACK",options.bend.backward);
  options.bend.landmarks_first=env("LM1",options.bend.landmarks_first);
  options.bend.landmarks_last=env("LM2",options.bend.landmarks_last);
  options.bend.hidden_stiffness_mm=env("HID",options.bend.hidden_stiffness_mm);
  options.bend.reach_first_mm=env("R1",options.bend.reach_first_mm);
  options.bend.reach_last_mm=env("R2",options.bend.reach_last_mm);
  options.first_stiffness_with_model_mm=env("FSM",options.first_stiffness_with_model_mm);
  options.person.measurements=env("MEAS",options.person.measurements);
  options.person.landmark_weight=env("PLM",options.person.landmark_weight);
  options.detail.reach_mm=env("DREACH",options.detail.reach_mm);
  options.detail.stiffness_edges=env("DSTIFF",options.detail.stiffness_edges);
  options.detail.rounds=(int)env("DROUNDS",options.detail.rounds);
  if(env("LAST",0)>0) options.bend.stiffness_mm.push_back(env("LAST",0));
  const WrapResult result = wrap(shape, model, truth.scan, truth.landmarks, std::nullopt, options);
  Measured m;
  m.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const Positions found =
      inverse(truth.pose).apply(result.pose.apply(result.positions));
  for (std::size_t i = 0; i < head.skin.vertices.size(); ++i) {
    const auto v = static_cast<Index>(head.skin.vertices[i]);
    const double error = (found.row(v) - head.positions.row(v)).norm();
    if (regions.skin[i]) m.skin.push_back(error);
    if (regions.face[i]) m.face.push_back(error);
    if (regions.eyes[i]) m.eyes.push_back(error);
    if (regions.lips[i]) m.lips.push_back(error);
    if (regions.skin[i] && !result.without_data[i]) {
      m.surface.push_back(result.distance_mm(static_cast<Index>(i)));
    }
  }
  if (std::getenv("DUMP")) {
    const Positions hn = skin_normals(head.skin, head.skin.of(head.positions));
    std::FILE* f = std::fopen(std::getenv("DUMP"), "w");
    for (std::size_t i = 0; i < head.skin.vertices.size(); ++i) {
      const auto v = static_cast<Index>(head.skin.vertices[i]);
      const Eigen::RowVector3d e = found.row(v) - head.positions.row(v);
      const double n = e.dot(hn.row(i));
      std::fprintf(f, "%zu %d %d %d %d %.2f %.3f %.3f %.3f %d %.1f %.1f %.1f\n", (size_t)v, (int)regions.skin[i], (int)regions.face[i], (int)regions.eyes[i], (int)regions.lips[i], head.skin.openness[i], n, (e - n * hn.row(i)).norm(), result.distance_mm(i), (int)result.without_data[i], head.positions(v,0), head.positions(v,1), head.positions(v,2));
    }
    std::fclose(f);
    for (const auto& l : result.landmarks) std::printf("%s %.1f\n", l.name.c_str(), l.pose_mm);
    std::printf("pose residual %.2f\n", result.pose_residual_mm);
  }
  m.flipped = TargetTriangles(shape.skin.triangles, shape.skin.of(shape.positions))
                  .compare(shape.skin.of(result.positions))
                  .flipped;
  return m;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: crowdface_measure_wrap HEADS_DIR [HEAD …] [--templates LIST]\n");
    return 64;
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(argv[1])) {
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::size_t> chosen;
  std::string templates = "one,mean,model";
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "--templates") == 0 && i + 1 < argc) {
      templates = argv[++i];
    } else if (const auto number = parse_unsigned(argv[i]); number && *number < files.size()) {
      chosen.push_back(*number);
    }
  }
  if (chosen.empty()) chosen = {0, 4, 5, 9, 10};
  Topology topology;
  std::vector<Positions> heads;
  for (const fs::path& file : files) {
    const ObjFile obj = read_obj(file);
    if (heads.empty()) topology = obj.topology;
    heads.emplace_back(obj.positions * 10);
  }
  std::map<std::string, std::uint32_t> marks;
  for (const WrapLandmark& landmark : kIctLandmarks) marks[landmark.name] = landmark.vertex;

  std::map<std::string, Measured> all;
  std::printf("%-22s %-13s %-13s %-6s %-6s %-6s flips\n", "template", "all skin", "face", "eyes",
              "lips", "to scan");
  for (const std::size_t h : chosen) {
    const WrapTemplate head = make_template(topology, heads[h], {});
    const test::TruthScan truth = test::make_truth_scan(head, kIctLandmarks, {.landmark_error_mm = std::getenv("LME")?std::atof(std::getenv("LME")):1.0, .seed = h + 1});
    const Regions regions = regions_of(head, marks);
    std::vector<Positions> others;
    for (std::size_t i = 0; i < heads.size(); ++i) {
      if (i != h) others.push_back(heads[i]);
    }
    const auto run = [&](const char* name, const WrapTemplate& shape, const ShapeModel* model) {
      if (templates.find(name) == std::string::npos) return;
      const Measured m = measure(shape, model, head, truth, regions);
      print_row(concat(name, " for ", h), m);
      Measured& sum = all[name];
      add(m.skin, sum.skin);
      add(m.face, sum.face);
      add(m.eyes, sum.eyes);
      add(m.lips, sum.lips);
      add(m.surface, sum.surface);
      sum.flipped += m.flipped;
      sum.seconds += m.seconds / static_cast<double>(chosen.size());
    };
    run("one", make_template(topology, heads[(h + 1) % heads.size()], {}), nullptr);
    const ShapeModel whole = make_model(others);
    const WrapTemplate mean = make_template(topology, whole.mean, {});
    run("mean", mean, nullptr);
    ShapeModel of_skin{mean.skin.of(whole.mean), {}};
    for (const Positions& mode : whole.modes) of_skin.modes.push_back(mean.skin.of(mode));
    if (std::getenv("FIT")) {
      const auto err=[&](const char*n,const Positions&p){std::vector<double> e,f; for(size_t i=0;i<head.skin.vertices.size();++i){double d=(p.row(i)-head.positions.row(head.skin.vertices[i])).norm(); if(regions.skin[i])e.push_back(d); if(regions.face[i])f.push_back(d);} std::printf("%s skin %.2f/%.2f face %.2f/%.2f\n",n,percentile(e,.5),percentile(e,.95),percentile(f,.5),percentile(f,.95));};
      const Positions target=head.skin.of(head.positions);
      const Similarity back=inverse(truth.pose);
      err("mean rigid", fit_similarity(of_skin.mean,target,ScaleFit::kUniform).apply(of_skin.mean));
      // best projection
      Eigen::MatrixXd U(target.size(),(Index)of_skin.modes.size()); for(size_t k=0;k<of_skin.modes.size();++k) U.col(k)=Eigen::Map<const Eigen::VectorXd>(of_skin.modes[k].data(),target.size());
      Positions diff=target-of_skin.mean; Eigen::VectorXd c=(U.transpose()*U).ldlt().solve(U.transpose()*Eigen::Map<Eigen::VectorXd>(diff.data(),diff.size()));
      err("projection", of_skin.shape(c)); std::printf("c %.2f\n", c.norm());
      { Positions best=of_skin.shape(c); err("proj+sim", fit_similarity(best,target,ScaleFit::kUniform).apply(best)); }
      ScanSurface sf(truth.scan); ShapeFit fit; Positions a(24,3),b(24,3); std::vector<WrapLandmark> lm; for(int i=0;i<24;++i){a.row(i)=of_skin.mean.row(truth.landmarks[i].vertex); b.row(i)=truth.landmarks[i].place.transpose(); lm.push_back(truth.landmarks[i]);}
      fit.pose=fit_similarity(a,b,ScaleFit::kUniform); err("lm", back.apply(fit.pose.apply(of_skin.mean)));
      fit=fit_shape(mean.skin,ShapeModel{of_skin.mean,{}},sf,lm,fit); err("icp", back.apply(fit.pose.apply(of_skin.mean)));
      for(double meas:{30.,150.,600.,3000.}) for(double plm:{0.1,0.5}){ ShapeFitOptions o={.reach_mm={20,16,12,8,6,4},.measurements=meas,.landmark_weight=plm}; ShapeFit g=fit_shape(mean.skin,of_skin,sf,lm,fit,o); std::printf("%g %g |c| %.2f scale %.3f ",meas,plm,g.coefficients.norm(), g.pose.scale/truth.pose.scale); err("model", back.apply(g.pose.apply(of_skin.shape(g.coefficients))));}
    }
    run("model", mean, &of_skin);
  }
  for (const auto& [name, m] : all) print_row(concat(name, ", all"), m);
}
