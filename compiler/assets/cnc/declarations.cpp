// CNC programs as ST.

#include "compiler/assets/cnc/internal.hpp"
#include "compiler/source/content_hash.hpp"
#include "compiler/syntax/global_names.hpp"
#include "compiler/syntax/st_text.hpp"
#include "runtime/numeric/cnc/queue_file.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <iterator>

namespace stc {

namespace {

using namespace stride::cnc;

constexpr std::string_view kCoordinates[kAxes] = {"dX",  "dY",  "dZ",  "dA",  "dB",  "dC",
                                                  "dA1", "dA2", "dA3", "dA4", "dA5", "dA6"};

/// A text of ST, at most 80 characters.
std::string textLiteral(std::string_view text) {
  std::string out = "'";
  size_t count = 0;
  for (const char c : text) {
    if (++count > 80)
      break;
    if (c == '$' || c == '\'')
      out += '$';
    if (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) >= 0x7F)
      out += fmt::format("${:02X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + "'";
}

std::string startText(const Position &start) {
  std::string text;
  for (int axis = 0; axis < kAxes; ++axis)
    if (start.coordinate[axis] != 0)
      text += fmt::format("{}{} := {}", text.empty() ? "" : ", ", kCoordinates[axis],
                          realLiteral(start.coordinate[axis]));
  if (start.axes != 0)
    text += fmt::format("{}wAuxData := {}", text.empty() ? "" : ", ", start.axes | 7);
  return text;
}

/// A word as it is packed: without its address, and with a mark where it has one.
std::string bytesOf(const std::vector<GCodeWord> &words) {
  std::string bytes;
  for (const GCodeWord &word : words) {
    GCodeWord plain;
    std::memset(&plain, 0, sizeof plain);
    plain.letter = word.letter;
    plain.variables = word.address != nullptr ? 1 : 0;
    plain.value = word.address != nullptr ? 0 : word.value;
    plain.integer = word.address != nullptr ? 0 : word.integer;
    bytes.append(reinterpret_cast<const char *>(&plain), sizeof plain);
  }
  return bytes;
}

std::string bytesOf(const std::vector<PathObject> &objects) {
  std::string bytes(objects.size() * sizeof(PathObject), '\0');
  auto *to = reinterpret_cast<uint8_t *>(bytes.data());
  for (const PathObject &object : objects) {
    writeFileObject(object, to);
    to += sizeof object;
  }
  return bytes;
}

class CncWriter {
public:
  CncWriter(const std::vector<ast::File *> &files, const CncTypes &types, Diagnostics &diagnostics)
      : files_(files), types_(types), names_(globalNames(files)), diagnostics_(diagnostics) {}

  SyntheticSource write(const std::vector<CncAsset> &assets) {
    for (const CncAsset &asset : assets) {
      const CncCompile compile = asset.program.settings.compile;
      std::vector<std::string> variables;
      if (compile != CncCompile::None && compile != CncCompile::TextFile)
        variables = variablesOf(asset.program);
      if ((compile != CncCompile::Program && compile != CncCompile::Queue) ||
          !isFree(asset.program))
        continue;
      if (out_.empty())
        out_.add("VAR_GLOBAL\n");
      if (compile == CncCompile::Program)
        declareProgram(asset.program, variables);
      else
        declareQueue(asset);
    }
    if (!out_.empty())
      out_.add("END_VAR\n");
    return std::move(out_);
  }

private:
  bool isFree(const CncProgram &program) {
    if (!isIdentifier(program.name)) {
      diagnostics_
          .report(Code::ConfigBadName, program.span,
                  fmt::format("`{}` cannot be a name in Structured Text", program.name),
                  "a CNC program is named after its file")
          .help("rename the file, or say in stride.toml that it does not become a variable: "
                "`compile = \"none\"` of its [[cnc]]");
      return false;
    }
    const auto [taken, isNew] = names_.try_emplace(lowerCase(program.name), program.span);
    if (isNew)
      return true;
    diagnostics_
        .report(Code::ConfigNameClash, program.span,
                fmt::format("the CNC program `{}` has the name of something in the program",
                            program.name),
                "becomes a global variable of this name")
        .label(taken->second, "already declared here")
        .help("rename one of them");
    return false;
  }

  /// What is packed, as hidden variables. They are named after what they hold, so that an online
  /// change gives a changed program new ones.
  struct Packed {
    std::string name;
    std::string source; ///< Arguments for who unpacks it.
  };

  Packed declarePacked(const CncProgram &program, std::string_view bytes, uint64_t salt) {
    const std::vector<std::string> pieces = gcode::packed(bytes);
    const size_t length = pieces.front().size();
    constexpr size_t kDigits = 8;
    Packed result;
    result.name = fmt::format("{}__{}", program.name,
                              ContentHash().add(bytes).add(salt).hex().substr(0, kDigits));
    out_.add(fmt::format("  {{attribute 'hide'}}\n  {}__text : ARRAY[0..{}] OF STRING({}) := [",
                         result.name, pieces.size() - 1, length));
    for (const std::string &piece : pieces)
      out_.add(fmt::format("{}'{}'", &piece == &pieces.front() ? "" : ",\n    ", piece),
               program.span);
    out_.add("];\n");
    result.source = fmt::format("ADR({}__text), {}", result.name, length);
    return result;
  }

  void declareProgram(const CncProgram &program, const std::vector<std::string> &variables) {
    const gcode::Sentences sentences(program);
    std::string fields = fmt::format("strProgramName := {}", textLiteral(program.title));
    if (const std::string start = startText(program.settings.start); !start.empty())
      fields += fmt::format(", piStartPosition := ({})", start);
    const auto count = static_cast<size_t>(sentences.size());
    if (count > 0) {
      ContentHash salt;
      for (const std::string &variable : variables)
        salt.add(variable);
      const Packed packed =
          declarePacked(program, bytesOf(sentences.words()),
                        std::stoull(salt.hex().substr(0, sizeof(uint64_t)), nullptr, kHex));
      declareVariables(program, packed.name, variables);
      out_.add(fmt::format("  {{attribute 'hide'}}\n  {} : ARRAY[0..{}] OF "
                           "SM_CNC.SMC_GCODE_WORD;\n",
                           packed.name, count - 1));
      fields += fmt::format(", nElements := {0}, pgc := SM_CNC.SMC_UnpackProgram({1}, ADR({2}), "
                            "{0}, {3})",
                            count, packed.source, packed.name,
                            variables.empty() ? "0" : fmt::format("ADR({}__vars)", packed.name));
    }
    out_.add(fmt::format("  /// The program of its CNC file.\n  {{attribute 'init_on_onlchange'}}\n"
                         "  {} : SM_CNC.SMC_CNC_REF := ({});\n",
                         program.name, fields),
             program.span);
  }

  /// The addresses for words with variables.
  void declareVariables(const CncProgram &program, const std::string &name,
                        const std::vector<std::string> &variables) {
    if (variables.empty())
      return;
    out_.add(fmt::format("  {{attribute 'hide'}}\n  {}__vars : ARRAY[0..{}] OF "
                         "SM_CNC.SMC_GCODE_WORD := [",
                         name, variables.size() - 1));
    size_t next = 0;
    for (const CncWord &word : program.words) {
      if (word.variable.empty())
        continue;
      out_.add(next == 0 ? "" : ",\n    ");
      out_.add(variables[next++], word.span);
    }
    out_.add("];\n");
  }

  void declareQueue(const CncAsset &asset) {
    const CncProgram &program = asset.program;
    const size_t count = asset.objects.size();
    constexpr size_t kLeastPlaces = 2;
    const size_t size = program.settings.queueBytes != 0
                            ? program.settings.queueBytes
                            : std::max(kLeastPlaces, count) * sizeof(PathObject);
    const size_t places = (size + sizeof(PathObject) - 1) / sizeof(PathObject);
    std::string memory = fmt::format("{}__memory", program.name);
    std::string source;
    if (count > 0) {
      const Packed packed = declarePacked(program, bytesOf(asset.objects), size);
      memory = packed.name;
      source = packed.source;
    }
    out_.add(fmt::format("  {{attribute 'hide'}}\n  {} : ARRAY[0..{}] OF SM_CNC.SMC_GEOINFO;\n",
                         memory, places - 1));
    const std::string buffer =
        count > 0 ? fmt::format("SM_CNC.SMC_UnpackQueue({}, ADR({}), {})", source, memory, count)
                  : fmt::format("ADR({})", memory);
    out_.add(fmt::format(
                 "  /// The path of its CNC file.\n  {} : SM_CNC.SMC_OUTQUEUE := (pbyBuffer "
                 ":= {}, nSize := {}, nWritePos := {}, bFull := {}, bEndOfList := TRUE, "
                 "byGenerator := {}, strProgramName := {});\n",
                 program.name, buffer, size, count * sizeof(PathObject),
                 size / sizeof(PathObject) - count <= kReservedPlaces ? "TRUE" : "FALSE",
                 int{kByEditor}, textLiteral(program.title.empty() ? program.name : program.title)),
             program.span);
  }

  /// The values of SMC_GCODE_WORD for the words with variables.
  std::vector<std::string> variablesOf(const CncProgram &program) {
    std::vector<std::string> variables;
    bool isM = false;
    for (const CncWord &word : program.words) {
      isM = word.word.letter != kEndOfSentence && (isM || word.word.letter == 'M');
      if (!word.variable.empty())
        variables.push_back(variableText(word, isM && word.word.letter == 'O'));
    }
    return variables;
  }

  /// `structure`: the word takes an SMC_M_PARAMETERS.
  std::string variableText(const CncWord &word, bool structure) {
    const std::optional<CncVariable> variable = cncVariable(files_, types_, word.variable);
    if (variable && (variable->type == VariableType::Structure) != structure)
      diagnostics_
          .report(Code::CncVariable, word.span,
                  fmt::format("the variable `{}` is of a type that does not fit", word.variable),
                  structure ? "an M function takes SMC_M_PARAMETERS" : "no number")
          .help("the word O of an M function takes a variable of type SMC_M_PARAMETERS, all "
                "others one of a type for numbers");
    if (!variable)
      diagnostics_
          .report(Code::CncVariable, word.span,
                  fmt::format("there is no variable `{}` that G-code can use", word.variable),
                  "unknown, or of another type")
          .help("a global variable, or `Program.Variable`, of a type for numbers, or a member or "
                "element of such a type; SMC_M_PARAMETERS for O of an M function");
    return fmt::format("(pAdr := ADR({}), byVarType := {})", variable ? word.variable : "0",
                       static_cast<int>(variable ? variable->type : VariableType::None));
  }

  static constexpr int kHex = 16;

  const std::vector<ast::File *> &files_;
  const CncTypes &types_;
  std::unordered_map<std::string, Span> names_;
  Diagnostics &diagnostics_;
  // The list has the name of V2.3's folder (manual, section 3.1).
  SyntheticSource out_{"<cnc>/CNC_Data.st"};
};

} // namespace

SyntheticSource cncDeclarations(const std::vector<CncAsset> &programs,
                                const std::vector<ast::File *> &files, const CncTypes &types,
                                Diagnostics &diagnostics) {
  return CncWriter(files, types, diagnostics).write(programs);
}

} // namespace stc
