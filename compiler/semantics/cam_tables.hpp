#ifndef STRIDE_COMPILER_SEMANTICS_CAM_TABLES_HPP
#define STRIDE_COMPILER_SEMANTICS_CAM_TABLES_HPP
// SMC_CAMTable_<type>_<places>_1 and …_2: structures of SM_DriveBasic that exist for each type and
// number of places (SoftMotion V2.3 manual, section 4.7). They are declared when a program names
// them.

#include <cstdint>
#include <string>
#include <string_view>

namespace stc {

/// The library to which the tables belong.
inline constexpr std::string_view kCamTableLibrary = "SM_DriveBasic";

/// Most places: MC_CAM_REF.nElements is an INT.
inline constexpr uint32_t kMaxCamPlaces = 32767;

/// What the name of a cam table says.
struct CamTableName {
  std::string name;         ///< as the library spells it
  std::string_view element; ///< `INT`, …, `LREAL`
  uint32_t places = 0;
  bool pairs = false;  ///< _2: master and slave position by turns
  std::string problem; ///< why there is no such table; empty: there is
  std::string help;    ///< what to write instead; empty: nothing better is known
};

/// Whether a name (in lower case) begins like that of a cam table.
[[nodiscard]] bool looksLikeCamTable(std::string_view lowerName);

/// Reads a name for which looksLikeCamTable() is true.
[[nodiscard]] CamTableName readCamTable(std::string_view lowerName);

/// The STRUCT as ST. `table` must have no problem.
[[nodiscard]] std::string camTableDeclaration(const CamTableName &table);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_CAM_TABLES_HPP
