// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/foreign_file.h"

#include <algorithm>
#include <array>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"

namespace crowdface {
namespace {

using namespace std::string_view_literals;

struct Known {
  std::string_view begin;  ///< text with which the file begins, in lower case
  std::string_view what;
};

/// The name of the first array in NumPy's archive (.npz), which is a ZIP archive of .npy files;
/// empty if the file is no such archive.
std::string_view first_npz_array(std::string_view bytes) {
  constexpr std::size_t kNameLength = 26, kName = 30;  // offsets in the header of a ZIP entry
  constexpr std::string_view kExtension = ".npy";
  if (!bytes.starts_with("PK\x03\x04") || bytes.size() < kName) return {};
  const std::string_view name =
      bytes.substr(kName, number_at<std::uint16_t>(bytes.data() + kNameLength));
  return name.ends_with(kExtension) ? name.substr(0, name.size() - kExtension.size())
                                    : std::string_view();
}

/// Formats recognised by their exact first bytes.
constexpr std::array kBinary = {
    Known{"PK\x03\x04"sv,
          "a ZIP archive: unpack it and name the mesh in it. Of a usdz file, save the text (usdcat "
          "--flatten -o head.usda FILE), or import it in Blender and export head.usda or GLB"},
    Known{"Rar!"sv, "a RAR archive: unpack it and name the mesh in it"},
    Known{"7z\xBC\xAF"sv, "a 7-Zip archive: unpack it and name the mesh in it"},
    Known{"\x1f\x8b"sv, "compressed with gzip: unpack it (gunzip)"},
    Known{"\x28\xB5\x2F\xFD"sv,
          "compressed with Zstandard, as Blender's scenes are: export the mesh as OBJ"},
    Known{"BLENDER"sv, "a scene of Blender: export the mesh as OBJ (File > Export > Wavefront)"},
    Known{"//Maya"sv, "a scene of Maya: export the mesh as OBJ or FBX"},
    Known{"FOR4"sv, "a scene of Maya: export the mesh as OBJ or FBX"},
    Known{"FOR8"sv, "a scene of Maya: export the mesh as OBJ or FBX"},
    Known{
        "PXR-USDC"sv,
        "binary USD (usdc): save it as text (usdcat --flatten -o head.usda FILE), or import it in "
        "Blender and export head.usda or GLB"},
    Known{"\xff\xfe"sv, "text in UTF-16: save it as UTF-8"},
    Known{"\xfe\xff"sv, "text in UTF-16: save it as UTF-8"},
    Known{"\x89PNG"sv, "a picture"},
    Known{"\xff\xd8\xff"sv, "a picture"},
    Known{"%PDF"sv, "a PDF document"}};

/// Files that a browser, a server or Git stored instead of the wanted file. Recognised by the start
/// of the text, ignoring case, leading whitespace and a byte-order mark.
constexpr std::array kNotDownloaded = {
    Known{"<!doctype"sv,
          "a web page, which a browser saved instead of the file: download the raw file"},
    Known{"<html"sv,
          "a web page, which a browser saved instead of the file: download the raw file"},
    Known{"<head"sv,
          "a web page, which a browser saved instead of the file: download the raw file"},
    Known{"version https://git-lfs"sv,
          "a pointer of Git LFS and not the file itself: fetch it (git lfs pull)"},
    Known{"404"sv, "the answer of a web server that has no such file: check the address"},
    Known{"403"sv,
          "the answer of a web server that refused the file: log in and download it again"},
    Known{"{\"error"sv, "the answer of a web server and not the file: download it again"},
    Known{"{\"message"sv, "the answer of a web server and not the file: download it again"}};

/// The start of a text in lower case, without leading whitespace and a byte-order mark.
std::string start_of_text(std::string_view bytes) {
  constexpr std::size_t kLooked = 200;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  return lower_case(bytes.substr(0, kLooked));
}

}  // namespace

std::string_view describe_failed_download(std::string_view bytes) {
  const std::string text = start_of_text(bytes);
  for (const Known& known : kNotDownloaded) {
    if (text.starts_with(known.begin)) return known.what;
  }
  return {};
}

std::string describe_numpy_archive(std::string_view bytes, const std::filesystem::path& path) {
  const std::string_view array = first_npz_array(bytes);
  if (array.empty()) return {};
  const std::string stem = path.stem().string();
  return concat("an archive of NumPy arrays: save each array alone, such as numpy.save(\"", stem,
                ".npy\", numpy.load(\"", stem, ".npz\")[\"", printable(array), "\"])");
}

void refuse_non_mesh_file(std::string_view bytes, const std::filesystem::path& path) {
  const auto refuse = [&](std::string_view what) {
    refuse_file(path, concat("expected a mesh, found ", what));
  };
  if (bytes.empty()) refuse("an empty file");
  if (const std::string found = describe_numpy_archive(bytes, path); !found.empty()) refuse(found);
  for (const Known& known : kBinary) {
    if (bytes.starts_with(known.begin)) refuse(known.what);
  }
  if (const auto found = describe_failed_download(bytes); !found.empty()) refuse(found);
  if (start_of_text(bytes).starts_with("<?xml")) {
    refuse(
        "XML and no mesh: if it is a web page or a server's answer, download the raw file; if it "
        "is COLLADA, export OBJ, FBX or GLB");
  }
}

std::string_view advice_on_bad_number(std::string_view word) {
  if (word.find(',') != word.npos) {
    return "; set the program's or the system's number format to a decimal point and export "
           "again";
  }
  for (const std::string_view none : {"nan", "#IND", "#QNAN", "inf"}) {
    if (word.find(none) != word.npos) {
      return "; this vertex has no position: delete it before exporting";
    }
  }
  return "";
}

}  // namespace crowdface
