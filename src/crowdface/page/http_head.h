// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crowdface {

/// The request line and header fields of an HTTP/1.1 request (RFC 9112).
struct HttpHead {
  std::string method;
  std::string path;  ///< the requested path, percent-decoded, without the query
  /// names (in lower case) and values of the header fields
  std::vector<std::pair<std::string, std::string>> fields;
  bool closes_connection = false;  ///< whether the connection ends after this request
  /// Number of header fields with this name.
  std::size_t count(std::string_view name) const;
  /// Value of the first header field with this name; empty if there is no such field.
  std::string_view value(std::string_view name) const;
};

/// Parses the head of a request.
/// \param text  the head of the request, including the empty line at the end of the head
/// \return nothing if the text is not a valid head
std::optional<HttpHead> parse_http_head(std::string_view text);

}  // namespace crowdface
