// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_faults.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/skin_contacts.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A template as if it had been wrapped onto itself, and regions by height: above the eyes, from there to
/// the base of the nose, and below.
class ScanFaults : public ::testing::Test {
 protected:
  ScanFaults() {
    const SyntheticHeads heads(8000, SyntheticHeads::Parts::kEyesAndTeeth);
    shape_ = make_template(heads.topology(), 10 * heads.positions(1, 1), {});
    result_.positions = shape_.positions;
    const auto count = shape_.skin.vertices.size();
    result_.distance_mm = Eigen::VectorXd::Zero(static_cast<Index>(count));
    result_.lacks_data.assign(count, false);
    regions_.names = {"brow", "nose", "mouth"};
    for (const std::uint32_t v : shape_.skin.vertices) {
      const double above_eyes = shape_.positions(v, 1) - ball().centre.y();
      regions_.region_of_vertex.push_back(above_eyes > 20 ? 0 : above_eyes > -40 ? 1 : 2);
    }
  }
  const Part& eye() const {
    return *std::find_if(shape_.parts.parts.begin(), shape_.parts.parts.end(),
                         [](const Part& part) { return part.is_eyeball; });
  }
  const ComponentShape& ball() const { return shape_.parts.shapes[eye().ball_component]; }
  std::vector<std::string> faults() const { return scan_faults(shape_, result_, regions_); }

  WrapTemplate shape_;
  WrapResult result_;
  SkinRegions regions_;
};

TEST_F(ScanFaults, AHeadThatIsTheTemplateHasNone) {
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(ScanFaults, AnotherSizeIsNone) {
  result_.positions *= 1.2;
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(ScanFaults, LidsThatMeetAreAClosedEye) {
  const Lids lids = find_lids(shape_.positions, PointGrid(shape_.positions, eye().vertices),
                              ball().centre, ball().radius, shape_.axes, shape_.skin.vertices);
  for (std::size_t i = 0; i < lids.rim.size(); ++i) {
    const std::uint32_t v = lids.vertices[lids.rim[i]];
    result_.positions(v, 1) =
        ball().centre.y() + 0.2 * (shape_.positions(v, 1) - ball().centre.y());
  }
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("an eye seems to be closed")));
}

TEST_F(ScanFaults, LipsThatPartAreAnOpenMouth) {
  const HeadSet faces{shape_.topology, {}, {{"template", shape_.positions}}};
  const SkinContacts lips(faces, shape_.adjacency, shape_.skin.vertices);
  ASSERT_GT(lips.size(), 0U);
  for (std::size_t i = 0; i < lips.size(); ++i) {
    for (const EdgePoint& point : lips.section(i).low_profile) {
      for (const std::uint32_t v : {point.a, point.b}) {
        result_.positions(v, 1) = shape_.positions(v, 1) - 9;
      }
    }
  }
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("the mouth seems to be open")));
}

TEST_F(ScanFaults, ASkullThatStandsOutIsHair) {
  for (std::size_t v = 0; v < regions_.region_of_vertex.size(); ++v) {
    const auto row = static_cast<Index>(shape_.skin.vertices[v]);
    if (regions_.region_of_vertex[v] != 0) continue;
    const Eigen::RowVector3d out = shape_.positions.row(row) - ball().centre.transpose();
    result_.positions.row(row) += 25 * out.normalized();
  }
  EXPECT_THAT(faults(), ElementsAre(AllOf(HasSubstr("above the brows the scan is "),
                                          Not(HasSubstr("from the scan;")))));
}

TEST_F(ScanFaults, ASkullThatIsFarFromTheScanIsHairOrAHat) {
  const auto make_far = [&](std::size_t step) {
    for (std::size_t v = 0; v < regions_.region_of_vertex.size(); ++v) {
      const bool is_far = regions_.region_of_vertex[v] == 0 && v % step == 0;
      result_.distance_mm(static_cast<Index>(v)) = is_far ? 5 : 0;
    }
  };
  make_far(4);
  // The message said "0 mm outside the template's head".
  EXPECT_THAT(faults(),
              ElementsAre(HasSubstr(
                  "hair or a hat: above the brows 25.1 % of the wrapped skin is more than 3 mm")));
  make_far(40);
  EXPECT_THAT(faults(), IsEmpty());
}

}  // namespace
}  // namespace crowdface::testing
