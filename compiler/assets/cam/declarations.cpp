// Cams as ST, and as cam files.

#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/source/content_hash.hpp"
#include "compiler/syntax/global_names.hpp"
#include "compiler/syntax/st_text.hpp"

#include "runtime/numeric/cam/element_block.hpp"

#include <array>
#include <cstring>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::cam;

constexpr std::array<std::string_view, 7> kElementNames = {"",      "INT",  "UINT", "DINT",
                                                           "UDINT", "REAL", "LREAL"};
constexpr std::array<std::string_view, 3> kPassNames = {"TAPPET_pos", "TAPPET_all", "TAPPET_neg"};
constexpr std::array<std::string_view, 4> kActionNames = {"TAPPETACTION_on", "TAPPETACTION_off",
                                                          "TAPPETACTION_inv", "TAPPETACTION_time"};
constexpr std::array<std::string_view, 5> kLawNames = {"polynomial", "harmonic", "cycloidal",
                                                       "modified_sine", "modified_trapezoid"};
constexpr std::array<std::string_view, 3> kPassWords = {"positive", "each", "negative"};
constexpr std::array<std::string_view, 4> kActionWords = {"on", "off", "invert", "timed"};

template <class T> T get(const CamData &data, int64_t index) {
  T value;
  std::memcpy(&value,
              reinterpret_cast<const char *>(data.storage.data()) + index * int64_t{sizeof value},
              sizeof value);
  return value;
}

std::string number(const CamData &data, int64_t index) {
  switch (data.header.element) {
  case Element::Int:
    return std::to_string(get<int16_t>(data, index));
  case Element::Uint:
    return std::to_string(get<uint16_t>(data, index));
  case Element::Dint:
    return std::to_string(get<int32_t>(data, index));
  case Element::Udint:
    return std::to_string(get<uint32_t>(data, index));
  case Element::Real:
    return realLiteral(static_cast<double>(get<float>(data, index)));
  case Element::Lreal:
    break;
  }
  return realLiteral(get<double>(data, index));
}

/// What pce points at: type and value.
struct Declared {
  std::string type;
  std::string value;
};

Declared tableOf(const CamData &data) {
  const int64_t count = data.header.elements;
  const bool pairs = data.header.form == Form::PairTable;
  Declared result;
  result.type =
      fmt::format("SM_DriveBasic.SMC_CAMTable_{}_{}_{}",
                  kElementNames[static_cast<size_t>(data.header.element)], count, pairs ? 2 : 1);
  result.value = "(Table := [";
  for (int64_t i = 0; i < count; ++i) {
    if (i > 0)
      result.value += ", ";
    result.value += pairs ? fmt::format("[{}, {}]", number(data, 2 * i), number(data, 2 * i + 1))
                          : number(data, i);
  }
  TableScaling scaling;
  std::memcpy(&scaling,
              reinterpret_cast<const char *>(data.storage.data()) +
                  scalingOffset(data.header.form, sizeOf(data.header.element), count),
              sizeof scaling);
  result.value += fmt::format(
      "], fEditorMasterMin := {}, fEditorMasterMax := {}, fEditorSlaveMin := {}, fEditorSlaveMax "
      ":= {}, fTableMasterMin := {}, fTableMasterMax := {}, fTableSlaveMin := {}, fTableSlaveMax "
      ":= {})",
      realLiteral(scaling.editorMasterMin), realLiteral(scaling.editorMasterMax),
      realLiteral(scaling.editorSlaveMin), realLiteral(scaling.editorSlaveMax),
      realLiteral(scaling.tableMasterMin), realLiteral(scaling.tableMasterMax),
      realLiteral(scaling.tableSlaveMin), realLiteral(scaling.tableSlaveMax));
  return result;
}

Declared nodesOf(const CamData &data) {
  Declared result{
      fmt::format("ARRAY[0..{}] OF SM_DriveBasic.SMC_CAMXYVA", data.header.elements - 1), "["};
  for (int64_t i = 0; i < data.header.elements; ++i) {
    const auto node = get<Node>(data, i);
    result.value += fmt::format("{}(dX := {}, dY := {}, dV := {}, dA := {})", i > 0 ? ", " : "",
                                realLiteral(node.x), realLiteral(node.y), realLiteral(node.v),
                                realLiteral(node.a));
  }
  result.value += "]";
  return result;
}

Declared segmentsOfData(const CamData &data) {
  Declared result{
      fmt::format("ARRAY[0..{}] OF SM_DriveBasic.SMC_CAM_SEGMENT", data.header.elements - 1), "["};
  for (int64_t i = 0; i < data.header.elements; ++i) {
    const auto segment = get<Segment>(data, i);
    std::string coefficients;
    for (const double c : segment.coefficients)
      coefficients += (coefficients.empty() ? "" : ", ") + realLiteral(c);
    result.value += fmt::format(
        "{}(dX0 := {}, dX1 := {}, aCoeff := [{}], dStroke := {}, dBegin := {}, dEnd := {}, dParam "
        ":= {}, dInflexion := {}, eLaw := SM_DriveBasic.SMC_CAM_LAW.{})",
        i > 0 ? ", " : "", realLiteral(segment.start), realLiteral(segment.end), coefficients,
        realLiteral(segment.stroke), realLiteral(segment.lawBegin), realLiteral(segment.lawEnd),
        realLiteral(segment.parameter), realLiteral(segment.inflexion),
        kLawNames[static_cast<size_t>(segment.law)]);
  }
  result.value += "]";
  return result;
}

Declared elementsOf(const CamData &data) {
  switch (data.header.form) {
  case Form::Nodes:
    return nodesOf(data);
  case Form::Segments:
    return segmentsOfData(data);
  case Form::EvenTable:
  case Form::PairTable:
    break;
  }
  return tableOf(data);
}

Declared tappetsOf(const std::vector<FileTappet> &tappets) {
  Declared result{fmt::format("ARRAY[0..{}] OF SM_DriveBasic.SMC_CAMTappet", tappets.size() - 1),
                  "["};
  for (const FileTappet &tappet : tappets)
    result.value += fmt::format(
        "{}(x := {}, iGroupID := {}, ctt := SM_DriveBasic.SMC_CAMTAPPETTYPE.{}, cta := "
        "SM_DriveBasic.SMC_CAMTAPPETACTION.{}, dwDelay := {}, dwDuration := {})",
        &tappet != tappets.data() ? ", " : "", realLiteral(tappet.x), tappet.group,
        kPassNames[static_cast<size_t>(tappet.pass)],
        kActionNames[static_cast<size_t>(tappet.action)], tappet.delay, tappet.duration);
  result.value += "]";
  return result;
}

class CamWriter {
public:
  CamWriter(const std::vector<ast::File *> &files, Diagnostics &diagnostics)
      : names_(globalNames(files)), diagnostics_(diagnostics) {}

  SyntheticSource write(const std::vector<CamSource> &cams) {
    for (const CamSource &cam : cams)
      declare(cam);
    if (count_ == 0)
      return std::move(out_);
    if (!names_.contains("_smc_cam_list"))
      out_.add(fmt::format("  /// The cams of the project's cam files.\n"
                           "  {{attribute 'init_on_onlchange'}}\n"
                           "  _SMC_CAM_LIST : ARRAY[0..{}] OF POINTER TO SM_DriveBasic.MC_CAM_REF "
                           ":= [{}];\n",
                           count_ - 1, list_));
    out_.add("END_VAR\n");
    if (!names_.contains("_smc_cam_count"))
      out_.add(fmt::format("VAR_GLOBAL CONSTANT\n  /// How many cams _SMC_CAM_LIST has.\n"
                           "  _SMC_CAM_COUNT : INT := {};\nEND_VAR\n",
                           count_));
    return std::move(out_);
  }

private:
  void declare(const CamSource &cam) {
    const auto [taken, isNew] = names_.try_emplace(lowerCase(cam.name.text), cam.name.span);
    if (!isNew) {
      diagnostics_
          .report(
              Code::ConfigNameClash, cam.name.span,
              fmt::format("the cam `{}` has the name of something in the program", cam.name.text),
              "becomes a global variable of this name")
          .label(taken->second, "already declared here")
          .help("rename one of them");
      return;
    }
    const std::optional<CamData> data = compileCam(cam, diagnostics_);
    if (!data || cam.compile.mode == CamMode::None)
      return;
    const CamFileHeader &header = data->header;
    const bool table = header.form == Form::EvenTable || header.form == Form::PairTable;
    std::string fields =
        fmt::format("xStart := {}, xEnd := {}, byType := {}, nElements := {}, nMaxElements := {}, "
                    "strCAMName := '{}'",
                    realLiteral(header.start), realLiteral(header.end),
                    static_cast<int>(header.form), header.elements, header.elements, cam.name.text);
    if (table)
      fields += fmt::format(", byVarType := {}, byInterpolationQuality := {}",
                            static_cast<int>(header.element), header.cubic ? 3 : 1);
    if (header.open)
      fields += fmt::format(", byCompatibilityMode := 1, fRise := {}", realLiteral(header.rise));
    if (header.elements != 0)
      fields += fmt::format(", pce := ADR({})", dataOf(cam, elementsOf(*data)));
    if (!data->tappets.empty())
      fields += fmt::format(", nTappets := {}, pt := ADR({})", data->tappets.size(),
                            dataOf(cam, tappetsOf(data->tappets)));
    add(cam, fmt::format("  /// The cam of its cam file.\n  {{attribute 'init_on_onlchange'}}\n"
                         "  {} : SM_DriveBasic.MC_CAM_REF := ({});\n",
                         cam.name.text, fields));
    list_ += fmt::format("{}ADR({})", count_ == 0 ? "" : ", ", cam.name.text);
    ++count_;
  }

  /// Declares data that the cam points at. It is named after what it holds, so that an online
  /// change gives a changed cam its new data, while what the program has changed in others stays.
  std::string dataOf(const CamSource &cam, const Declared &declared) {
    std::string name =
        fmt::format("{}__{}", cam.name.text,
                    ContentHash().add(declared.type).add(declared.value).hex().substr(0, 8));
    add(cam, fmt::format("  {{attribute 'hide'}}\n  {} : {} := {};\n", name, declared.type,
                         declared.value));
    return name;
  }

  void add(const CamSource &cam, const std::string &text) {
    if (out_.empty())
      out_.add("VAR_GLOBAL\n");
    out_.add(text, cam.name.span);
  }

  std::unordered_map<std::string, Span> names_;
  Diagnostics &diagnostics_;
  // The list of the cams has this file's name, as in CoDeSys (manual, section 4.7).
  SyntheticSource out_{"<cams>/CAM_Data.st"};
  std::string list_;
  size_t count_ = 0;
};

/// TOML's numbers are ST's, with a fraction.
std::string tomlNumber(double value) { return realLiteral(value == 0 ? 0 : value); }

} // namespace

SyntheticSource camDeclarations(const std::vector<CamSource> &cams,
                                const std::vector<ast::File *> &files, Diagnostics &diagnostics) {
  return CamWriter(files, diagnostics).write(cams);
}

std::string camFileText(const CamSource &cam, std::string_view comment) {
  std::string text = fmt::format("# {}\n", comment);
  if (!cam.name.text.empty())
    text += fmt::format("name = \"{}\"\n", cam.name.text);
  if (cam.periodic) {
    text += "periodic = true\n";
    if (cam.interval != 0)
      text += fmt::format("interval = {}\n", tomlNumber(cam.interval));
  }
  text +=
      fmt::format("\n[master]\nstart = {}\nend = {}\n", tomlNumber(cam.start), tomlNumber(cam.end));
  for (const CamElement &element : cam.elements) {
    const bool point = element.kind == CamElement::Kind::Point;
    const bool line = element.kind == CamElement::Kind::Line;
    const auto node = [&](const Node &at, std::string_view suffix) {
      text += fmt::format("x{0} = {1}\ny{0} = {2}\n", suffix, tomlNumber(at.x), tomlNumber(at.y));
      // What a periodic cam has at its end is what it has at its start.
      if (!line && !(cam.periodic && point && at.x == cam.end))
        text += fmt::format("v{0} = {1}\na{0} = {2}\n", suffix, tomlNumber(at.v), tomlNumber(at.a));
    };
    text += fmt::format("\n[[{}]]\n", point ? "point" : line ? "line" : "law");
    node(element.left, "");
    if (!point)
      node(element.right, "_end");
    if (!point && !line) {
      text += fmt::format("law = \"{}\"\n", kLawNames[static_cast<size_t>(element.shape.law)]);
      if (element.shape.law == Law::ModifiedSine)
        text += fmt::format("parameter = {}\n", tomlNumber(element.shape.parameter));
      if (element.shape.law != Law::Polynomial)
        text += fmt::format("inflexion = {}\n", tomlNumber(element.shape.inflexion));
    }
  }
  for (const FileTappet &tappet : cam.tappets) {
    text += fmt::format("\n[[tappet]]\nx = {}\ngroup = {}\npass = \"{}\"\naction = \"{}\"\n",
                        tomlNumber(tappet.x), tappet.group,
                        kPassWords[static_cast<size_t>(tappet.pass)],
                        kActionWords[static_cast<size_t>(tappet.action)]);
    if (tappet.action == 3)
      text += fmt::format("delay = {}\nduration = {}\n", tappet.delay, tappet.duration);
  }
  return text;
}

} // namespace stc
