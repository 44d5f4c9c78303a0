// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/surface_kind.h"

#include <gtest/gtest.h>

namespace crowdface {
namespace {

TEST(SurfaceKind, UsualNamesAreRecognised) {
  for (const char* name : {"M_ScleraLeft", "eyeball_R", "Eye White", "EYE_L"}) {
    EXPECT_EQ(surface_kind_of_material(name), SurfaceKind::kEye) << name;
  }
  for (const char* name : {"M_IrisRight", "pupil"}) {
    EXPECT_EQ(surface_kind_of_material(name), SurfaceKind::kIris) << name;
  }
  EXPECT_EQ(surface_kind_of_material("M_Teeth"), SurfaceKind::kTeeth);
  EXPECT_EQ(surface_kind_of_material("M_GumsTongue"), SurfaceKind::kGums);
  for (const char* name : {"M_EyeLashes", "M_LacrimalFluid", "TearLine", "M_EyeOcclusion",
                           "M_EyeBlend", "eye_shell", "Cornea"}) {
    EXPECT_EQ(surface_kind_of_material(name), SurfaceKind::kHidden) << name;
  }
  for (const char* name : {"M_Face", "M_BackHead", "", "eyelid_upper", "EyeBrows", "lambert1"}) {
    EXPECT_EQ(surface_kind_of_material(name), SurfaceKind::kSkin) << name;
  }
}

}  // namespace
}  // namespace crowdface
