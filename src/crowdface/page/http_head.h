// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crowdface {

/// What stands before the body of an HTTP/1.1 request (RFC 9112).
struct HttpHead {
  std::string method;
  std::string path;                                         ///< decoded, without the query
  std::vector<std::pair<std::string, std::string>> fields;  ///< names in lower case
  bool is_last = false;  ///< the client closes the connection afterwards

  std::size_t count(std::string_view name) const;
  /// The first of that name; empty if there is none.
  std::string_view value(std::string_view name) const;
};

/// \param text  up to the empty line, that line included.
/// \return nothing if that is no head of a request.
std::optional<HttpHead> parse_http_head(std::string_view text);

}  // namespace crowdface
