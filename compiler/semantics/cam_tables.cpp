#include "compiler/semantics/cam_tables.hpp"

#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

namespace stc {

namespace {

constexpr std::string_view kPrefix = "smc_camtable";
constexpr std::array<std::string_view, 6> kElements = {"INT",   "UINT", "DINT",
                                                       "UDINT", "REAL", "LREAL"};
constexpr std::string_view kForm = "SMC_CAMTable_<type>_<places>_1 or …_2";

std::string raised(std::string_view text) {
  std::string result(text);
  for (char &c : result)
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return result;
}

std::vector<std::string_view> parts(std::string_view text) {
  std::vector<std::string_view> result;
  while (true) {
    const size_t end = text.find('_');
    result.push_back(text.substr(0, end));
    if (end == std::string_view::npos)
      return result;
    text.remove_prefix(end + 1);
  }
}

bool isNumber(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string nameOfTable(std::string_view element, std::string_view places, bool pairs) {
  return "SMC_CAMTable_" + std::string(element) + "_" + std::string(places) + (pairs ? "_2" : "_1");
}

} // namespace

bool looksLikeCamTable(std::string_view lowerName) { return lowerName.starts_with(kPrefix); }

CamTableName readCamTable(std::string_view lowerName) {
  CamTableName table;
  const std::vector<std::string_view> words = parts(lowerName.substr(kPrefix.size()));
  if (words.size() != 4 || !words[0].empty()) {
    table.problem = "a cam table's name has another form";
    table.help = "write " + std::string(kForm) + ", for example `SMC_CAMTable_REAL_128_1`";
    return table;
  }
  for (const std::string_view element : kElements)
    if (lowerCase(element) == words[1])
      table.element = element;
  if (table.element.empty()) {
    table.problem = "no cam table has numbers of type " + raised(words[1]);
    table.help = "possible: INT, UINT, DINT, UDINT, REAL, LREAL";
    return table;
  }
  std::string_view places = words[2];
  while (places.size() > 1 && places.front() == '0')
    places.remove_prefix(1);
  table.pairs = words[3] == "2";
  if (!isNumber(places)) {
    table.problem = "`" + raised(words[2]) + "` is not a number of places";
    table.help = "write a number, for example `" + nameOfTable(table.element, "128", table.pairs) +
                 "`; the name of a constant cannot stand there";
    return table;
  }
  const auto *const end = places.data() + places.size();
  const bool fits = std::from_chars(places.data(), end, table.places).ec == std::errc();
  if (!fits || table.places > kMaxCamPlaces) {
    table.problem = "a cam has at most " + std::to_string(kMaxCamPlaces) + " places";
    table.help = "MC_CAM_REF counts its places with an INT (nElements)";
    return table;
  }
  if (table.places == 0) {
    table.problem = "a cam table has at least 1 place";
    return table;
  }
  if (words[3] != "1" && words[3] != "2") {
    table.problem = "a cam table ends with `_1` or `_2`";
    table.help = "`" + nameOfTable(table.element, places, false) +
                 "` holds slave positions at even distances of the master, `" +
                 nameOfTable(table.element, places, true) + "` pairs of master and slave position";
    return table;
  }
  table.name = nameOfTable(table.element, places, table.pairs);
  if (places.size() != words[2].size()) {
    table.problem = "the number of places has no zeros in front";
    table.help = "write `" + table.name + "`";
  }
  return table;
}

std::string camTableDeclaration(const CamTableName &table) {
  const std::string element(table.element);
  const std::string range = "ARRAY[0.." + std::to_string(table.places - 1) + "] OF ";
  std::string text = table.pairs
                         ? "/// A cam as pairs of master and slave position (MC_CAM_REF.byType 2), "
                           "ascending by the master.\n"
                         : "/// A cam as slave positions at even distances of the master "
                           "(MC_CAM_REF.byType 1).\n";
  text += "/// Source: SoftMotion V2.3 manual, section 4.7.\n";
  text += "TYPE " + table.name + " :\nSTRUCT\n";
  text += table.pairs ? "  /// Table[i][0] is a master position, Table[i][1] the slave position.\n"
                      : "  /// The slave positions.\n";
  text += "  Table : " + range + (table.pairs ? "ARRAY[0..1] OF " : "") + element + ";\n";
  text += "\n  /// Master position to which fTableMasterMin belongs. [master u]\n"
          "  fEditorMasterMin : REAL := 0;\n"
          "  /// Master position to which fTableMasterMax belongs. [master u]\n"
          "  fEditorMasterMax : REAL := 1;\n"
          "  /// Slave position to which fTableSlaveMin belongs. [slave u]\n"
          "  fEditorSlaveMin : REAL := 0;\n"
          "  /// Slave position to which fTableSlaveMax belongs. [slave u]\n"
          "  fEditorSlaveMax : REAL := 1;\n"
          "  /// What the table has for fEditorMasterMin.\n"
          "  fTableMasterMin : REAL := 0;\n"
          "  /// What the table has for fEditorMasterMax.\n"
          "  fTableMasterMax : REAL := 1;\n"
          "  /// What the table has for fEditorSlaveMin.\n"
          "  fTableSlaveMin : REAL := 0;\n"
          "  /// What the table has for fEditorSlaveMax.\n"
          "  fTableSlaveMax : REAL := 1;\n"
          "END_STRUCT\nEND_TYPE\n";
  return text;
}

} // namespace stc
