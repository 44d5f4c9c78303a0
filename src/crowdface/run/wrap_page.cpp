// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/wrap_page.h"

#include <algorithm>
#include <string_view>
#include <tuple>

#include <nlohmann/json.hpp>

#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

constexpr std::string_view kPageHead = R"(<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>Wrapped scans</title>
<style>
  body { font: 15px sans-serif; margin: 2em; }
  section { border-top: 1px solid #ccc; padding: 1em 0; }
  img { max-width: 100%; }
</style>
<h1>Wrapped scans, the most doubtful first</h1>
)";

/// The content of one scan's section on the page.
struct ScanRow {
  std::string name, picture;
  /// the feature, such as "nose", whose relief changed most in the wrap
  std::string worst_feature;
  /// correlation between the reliefs of template and wrapped head at `worst_feature`
  double agreement = 1;
  double distance_mm = 0;  ///< 95th percentile of the distance between skin and scan
  bool has_head = false;
  std::vector<std::string> warnings;

  /// Sort key. A smaller key means a more doubtful scan.
  auto key() const { return std::tuple(has_head, agreement, -distance_mm, name); }
};

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

/// Percent-encodes a file name for use as a relative URL.
std::string percent_encoded(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       c == '.' || c == '-' || c == '_';
    if (plain) {
      text += c;
    } else {
      text += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
  }
  return text;
}

ScanRow row_of(const WrappedScan& scan) {
  ScanRow row;
  row.name = scan.scan_file.filename().string();
  if (path_exists(scan.picture_file)) row.picture = scan.picture_file.filename().string();
  if (!path_exists(scan.report_file)) return row;
  const auto report = parse_shallow_json(read_file(scan.report_file));
  if (!report.is_object()) return row;
  try {
    row.has_head = !report.at("mesh").get<std::string>().empty();
    row.distance_mm = report.at("distance_mm").at("95 %").get<double>();
    row.warnings = report.at("warnings").get<std::vector<std::string>>();
    if (report.contains("features")) {
      for (const auto& [name, agreement] : report["features"].items()) {
        if (agreement.get<double>() >= row.agreement) continue;
        row.agreement = agreement.get<double>();
        row.worst_feature = name;
      }
    }
  } catch (const nlohmann::ordered_json::exception&) {
    row.has_head = false;  // another program wrote this report
  }
  return row;
}

}  // namespace

std::string wrap_page(const std::vector<WrappedScan>& scans) {
  std::vector<ScanRow> rows;
  for (const WrappedScan& scan : scans) rows.push_back(row_of(scan));
  std::ranges::sort(rows, {}, &ScanRow::key);
  std::string page(kPageHead);
  for (const ScanRow& row : rows) {
    page += concat("<section>\n<h2>", escaped(row.name), "</h2>\n<p>");
    if (!row.has_head) page += "No head. ";
    if (!row.worst_feature.empty()) {
      page += concat("Least agreement: ", escaped(row.worst_feature), ", ",
                     format_fixed(row.agreement, 2), ". 95 % of the skin within ",
                     format_fixed(row.distance_mm, 2), " mm of the scan.");
    }
    page += "</p>\n";
    if (!row.warnings.empty()) {
      page += "<ul>\n";
      for (const std::string& warning : row.warnings) {
        page += concat("<li>", escaped(warning), "</li>\n");
      }
      page += "</ul>\n";
    }
    if (!row.picture.empty()) {
      page +=
          concat("<img loading=\"lazy\" alt=\"\" src=\"", percent_encoded(row.picture), "\">\n");
    }
    page += "</section>\n";
  }
  return page + "</html>\n";
}

}  // namespace crowdface
