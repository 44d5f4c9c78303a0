// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/decomposed_text.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// A combining mark, the letters that it combines with, and the composed letters in the same order.
struct CombiningMark {
  std::string_view mark, letters, composed;
};

// From UnicodeData.txt, without letters that only few languages use.
constexpr CombiningMark kMarks[] = {
    {"\u0300", "AEIOUaeiouЕИеиÂâĂăÊêÔôƠơƯưYy", "ÀÈÌÒÙàèìòùЀЍѐѝẦầẰằỀềỒồỜờỪừỲỳ"},
    {"\u0301", "AEIOUYaeiouyCcLlNnRrSsZzΑΕΗΙΟΥΩϊαεηιϋουωГКгкÂâĂăÊêÔôƠơƯư",
     "ÁÉÍÓÚÝáéíóúýĆćĹĺŃńŔŕŚśŹźΆΈΉΊΌΎΏΐάέήίΰόύώЃЌѓќẤấẮắẾếỐốỚớỨứ"},
    {"\u0302", "AEIOUaeiouCcGgHhJjSsWwYyẠạẸẹỌọ", "ÂÊÎÔÛâêîôûĈĉĜĝĤĥĴĵŜŝŴŵŶŷẬậỆệỘộ"},
    {"\u0303", "ANOanoIiUuÂâĂăEeÊêÔôƠơƯưYy", "ÃÑÕãñõĨĩŨũẪẫẴẵẼẽỄễỖỗỠỡỮữỸỹ"},
    {"\u0304", "AaEeIiOoUu", "ĀāĒēĪīŌōŪū"},
    {"\u0306", "AaEeGgIiOoUuУИиуẠạ", "ĂăĔĕĞğĬĭŎŏŬŭЎЙйўẶặ"},
    {"\u0307", "CcEeGgIZz", "ĊċĖėĠġİŻż"},
    {"\u0308", "AEIOUaeiouyYΙΥιυЕІеі", "ÄËÏÖÜäëïöüÿŸΪΫϊϋЁЇёї"},
    {"\u0309", "AaÂâĂăEeÊêIiOoÔôƠơUuƯưYy", "ẢảẨẩẲẳẺẻỂểỈỉỎỏỔổỞởỦủỬửỶỷ"},
    {"\u030a", "AaUu", "ÅåŮů"},
    {"\u030b", "OoUu", "ŐőŰű"},
    {"\u030c", "CcDdEeLlNnRrSsTtZz", "ČčĎďĚěĽľŇňŘřŠšŤťŽž"},
    {"\u031b", "OoUu", "ƠơƯư"},
    {"\u0323", "AaEeIiOoƠơUuƯưYy", "ẠạẸẹỊịỌọỢợỤụỰựỴỵ"},
    {"\u0327", "CcGgKkLlNnRrSsTt", "ÇçĢģĶķĻļŅņŖŗŞşŢţ"},
    {"\u0328", "AaEeIiUu", "ĄąĘęĮįŲų"},
    {"\u3099",
     "かきくけこさしすせそたちつてとはひふへほうゝカキクケコサシスセソタチツテトハヒフヘホウワヰヱ"
     "ヲヽ",
     "がぎぐげござじずぜぞだぢづでどばびぶべぼゔゞガギグゲゴザジズゼゾダヂヅデドバビブベボヴヷヸヹ"
     "ヺヾ"},
    {"\u309a", "はひふへほハヒフヘホ", "ぱぴぷぺぽパピプペポ"}};

std::string_view take_character(std::string_view& text) {
  const std::string_view character = text.substr(0, std::max<std::size_t>(utf8_length(text), 1));
  text.remove_prefix(character.size());
  return character;
}

/// Maps each composed letter of kMarks to its decomposition: a letter and a mark. The letter in the
/// decomposition may itself be a composed letter.
const std::map<std::string_view, std::string>& pairs_by_composed_letter() {
  static const auto pairs = [] {
    std::map<std::string_view, std::string> result;
    for (auto [mark, letters, composed] : kMarks) {
      while (!composed.empty()) {
        std::string pair(take_character(letters));
        result[take_character(composed)] = pair.append(mark);
      }
    }
    return result;
  }();
  return pairs;
}

/// Encodes a code point from U+0800 to U+FFFF as UTF-8, which needs three bytes.
std::string three_bytes(std::uint32_t code) {
  return {static_cast<char>(0xe0U | code >> 12U), static_cast<char>(0x80U | (code >> 6U & 0x3fU)),
          static_cast<char>(0x80U | (code & 0x3fU))};
}

/// Decomposes a Korean syllable (The Unicode Standard, section 3.12). Empty if `character` is no
/// Korean syllable.
std::string decomposed_syllable(std::string_view character) {
  constexpr std::uint32_t kSyllables = 0xac00, kLeads = 0x1100, kVowels = 0x1161, kTails = 0x11a7,
                          kTailCount = 28, kPerLead = 588, kSyllableCount = 11172;
  if (character.size() != 3) return {};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  const std::uint32_t code = (byte(0) & 0xfU) << 12U | (byte(1) & 0x3fU) << 6U | (byte(2) & 0x3fU);
  if (code < kSyllables || code >= kSyllables + kSyllableCount) return {};
  const std::uint32_t index = code - kSyllables, tail = index % kTailCount;
  return three_bytes(kLeads + index / kPerLead) +
         three_bytes(kVowels + index % kPerLead / kTailCount) +
         (tail > 0 ? three_bytes(kTails + tail) : "");
}

}  // namespace

std::string decomposed(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::string_view character = take_character(text);
    const auto pair = pairs_by_composed_letter().find(character);
    if (pair != pairs_by_composed_letter().end()) {
      result += decomposed(pair->second);
      continue;
    }
    const std::string syllable = decomposed_syllable(character);
    result += syllable.empty() ? character : syllable;
  }
  return result;
}

}  // namespace crowdface
