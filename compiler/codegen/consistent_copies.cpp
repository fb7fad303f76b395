#include "compiler/codegen/consistent_copies.hpp"

namespace stc::codegen {

/// Its member of the state.
std::string ConsistentCopies::member(const ConsistentVariable &v) {
  return rootName(c_.names, {v.variable->globals, false}, c_.program.user) +
         std::string(mangle(v.variable->name.text)) + "__copies";
}

/// The variable in its state.
std::string ConsistentCopies::live(const ConsistentVariable &v) {
  return "app__(ctx__)." + rootName(c_.names, {v.variable->globals, false}, c_.program.user) + "." +
         std::string(mangle(v.variable->name.text));
}

std::string ConsistentCopies::members() {
  std::string out;
  for (const ConsistentVariable &v : all())
    out += "  ::stride::Consistent<" + std::string(c_.names.type(v.variable->type)) + ", " +
           std::to_string(tasks_) + ", " + std::to_string(v.readers.size()) + "> " + member(v) +
           ";\n";
  return out;
}

std::string ConsistentCopies::places() {
  std::string out;
  for (const ConsistentVariable &v : all()) {
    out += "const ::stride::ULINT " + copiesLocalPlace(c_.names, v.variable) +
           " = offsetof(::st::user::App__, " + member(v) + ");\n";
  }
  return out.empty() ? out
                     : "\nnamespace st::" + std::string(c_.names.space(c_.program.user)) + " {\n" +
                           out + "}\n";
}

std::string ConsistentCopies::begin() {
  std::string out;
  for (const ConsistentVariable &v : all())
    out += "  app__(ctx__)." + member(v) + ".begin(*ctx__, " + live(v) + ");\n";
  return out;
}

std::string ConsistentCopies::settle() {
  if (empty())
    return {};
  std::string out =
      "\n// What the tasks read of each other.\nvoid settle__(::stride::Ctx *ctx__) {\n";
  for (const ConsistentVariable &v : all()) {
    out += "  app__(ctx__)." + member(v) + ".settle(*ctx__, " + live(v) + ", {";
    for (size_t i = 0; i < v.readers.size(); ++i)
      out += (i == 0 ? "" : ", ") + std::to_string(v.readers[i]);
    out += "});\n";
  }
  return out + "}\n";
}

std::string ConsistentCopies::take(size_t task) {
  std::string out;
  for (const ConsistentVariable &v : all()) {
    for (size_t i = 0; i < v.readers.size(); ++i) {
      if (v.readers[i] == task)
        out += "  app__(ctx__)." + member(v) + ".take(*ctx__, " + std::to_string(i) + ");\n";
    }
  }
  return out;
}

std::string ConsistentCopies::give(size_t task) {
  std::string out;
  for (const ConsistentVariable &v : all()) {
    if (v.writer == task)
      out += "  app__(ctx__)." + member(v) + ".give(" + live(v) + ");\n";
  }
  return out;
}

} // namespace stc::codegen
