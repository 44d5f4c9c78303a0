// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace crowdface {

struct Parent;

/// Returns the id of sampled face `index`: the crowd's name and at least four digits.
std::string face_id(const std::string& crowd, std::uint64_t index);
/// Returns the id of a family's member, such as "NAME_FAMILY_01".
std::string member_id(const std::string& crowd, const std::string& family, int member);
/// Returns the full id of a new parent of a family: "NAME_FAMILY_mother".
std::string parent_id(const std::string& crowd, const Parent& parent);

}  // namespace crowdface
