// CNC programs as ST.

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/source/content_hash.hpp"
#include "compiler/syntax/global_names.hpp"
#include "compiler/syntax/st_text.hpp"

#include <fmt/format.h>

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

class CncWriter {
public:
  CncWriter(const std::vector<ast::File *> &files, Diagnostics &diagnostics)
      : files_(files), names_(globalNames(files)), diagnostics_(diagnostics) {}

  SyntheticSource write(const std::vector<CncProgram> &programs) {
    for (const CncProgram &program : programs)
      if (program.settings.compile && isFree(program))
        declare(program);
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

  void declare(const CncProgram &program) {
    std::vector<CncVariable> storage;
    const std::vector<GCodeWord> words = wordsOf(program, storage);
    if (out_.empty())
      out_.add("VAR_GLOBAL\n");
    std::string fields = fmt::format("strProgramName := {}", textLiteral(program.title));
    if (const std::string start = startText(program.settings.start); !start.empty())
      fields += fmt::format(", piStartPosition := ({})", start);
    if (!words.empty())
      fields += fmt::format(", nElements := {}, pgc := ADR({})", words.size(),
                            declareWords(program, words));
    out_.add(fmt::format("  /// The program of its CNC file.\n  {{attribute 'init_on_onlchange'}}\n"
                         "  {} : SM_CNC.SMC_CNC_REF := ({});\n",
                         program.name, fields),
             program.span);
  }

  /// Declares the words, named after what they are, so that an online change gives a changed
  /// program new ones.
  std::string declareWords(const CncProgram &program, const std::vector<GCodeWord> &words) {
    const size_t added = words.size() - program.words.size();
    std::vector<std::string> texts;
    ContentHash hash;
    for (size_t i = 0; i < words.size(); ++i) {
      const CncWord *source = i < added ? nullptr : &program.words[i - added];
      const bool structure =
          static_cast<VariableType>(words[i].variables) == VariableType::Structure;
      texts.push_back(wordText(words[i], source, structure));
      hash.add(texts.back());
    }
    std::string name = fmt::format("{}__{}", program.name, hash.hex().substr(0, 8));
    out_.add(
        fmt::format("  {{attribute 'hide'}}\n  {} : ARRAY[0..{}] OF SM_CNC.SMC_GCODE_WORD := [",
                    name, words.size() - 1));
    for (size_t i = 0; i < words.size(); ++i) {
      if (i > 0)
        out_.add(",\n    ");
      out_.add(texts[i], i < added ? program.span : program.words[i - added].span);
    }
    out_.add("];\n");
    return name;
  }

  /// `structure`: the word takes an SMC_M_PARAMETERS.
  std::string wordText(const GCodeWord &word, const CncWord *source, bool structure) {
    if (source == nullptr || source->variable.empty())
      return fmt::format("(byLetter := {}, fValue := {}, diValue := {})", word.letter,
                         realLiteral(word.value), word.integer);
    const std::optional<VariableType> type = cncVariableType(files_, source->variable);
    if (type && (*type == VariableType::Structure) != structure)
      diagnostics_
          .report(Code::CncVariable, source->span,
                  fmt::format("the variable `{}` is of a type that does not fit", source->variable),
                  structure ? "an M function takes SMC_M_PARAMETERS" : "no number")
          .help("the word O of an M function takes a variable of type SMC_M_PARAMETERS, all "
                "others one of a type for numbers");
    if (!type)
      diagnostics_
          .report(Code::CncVariable, source->span,
                  fmt::format("there is no variable `{}` that G-code can use", source->variable),
                  "unknown, or of another type")
          .help("a global variable, or `Program.Variable`, of a type for numbers; "
                "SMC_M_PARAMETERS for O of an M function");
    return fmt::format("(byLetter := {}, pAdr := ADR({}), byVarType := {})", word.letter,
                       type ? source->variable : "0",
                       static_cast<int>(type.value_or(VariableType::None)));
  }

  const std::vector<ast::File *> &files_;
  std::unordered_map<std::string, Span> names_;
  Diagnostics &diagnostics_;
  // The list has the name of V2.3's folder (manual, section 3.1).
  SyntheticSource out_{"<cnc>/CNC_Data.st"};
};

} // namespace

SyntheticSource cncDeclarations(const std::vector<CncProgram> &programs,
                                const std::vector<ast::File *> &files, Diagnostics &diagnostics) {
  return CncWriter(files, diagnostics).write(programs);
}

} // namespace stc
