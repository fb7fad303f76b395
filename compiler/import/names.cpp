#include "compiler/import/names.hpp"

#include "compiler/import/st_words.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// Words that cannot be names here, and could be names in CoDeSys V2.3.
constexpr std::array<std::string_view, 8> kReservedHere = {
    "ldate", "ldt", "ltime", "ltod", "reference", "var_inst", "var_stat", "var_temp"};

std::string_view kindOf(ObjectKind kind) {
  switch (kind) {
  case ObjectKind::Pou:
    return "POU";
  case ObjectKind::Type:
    return "type";
  case ObjectKind::Source:
    return "source file";
  case ObjectKind::GlobalList:
    break;
  }
  return "global variable list";
}

/// Whether the names of the two clash: lists have names of their own. The name of a source file
/// declares nothing, but the same one may come twice.
bool clash(const Object &a, const Object &b) {
  if (a.kind == ObjectKind::Source || b.kind == ObjectKind::Source)
    return a.kind == b.kind && a.text == b.text;
  return (a.kind == ObjectKind::GlobalList) == (b.kind == ObjectKind::GlobalList);
}

/// The words only: comments and blanks may differ.
std::string essenceOf(std::string_view text) {
  std::string result;
  for (const StWord &word : wordsOf(text)) {
    result += lowerCase(text.substr(word.begin, word.end - word.begin));
    result += ' ';
  }
  return result;
}

void takeObjectsOnce(Model &model) {
  std::multimap<std::string, size_t> byName;
  std::vector<Object> kept;
  for (Object &object : model.objects) {
    const std::string name = lowerCase(object.name);
    const auto [begin, end] = byName.equal_range(name);
    const auto first = std::find_if(
        begin, end, [&](const auto &each) { return clash(kept[each.second], object); });
    if (first == end) {
      byName.emplace(name, kept.size());
      kept.push_back(std::move(object));
      continue;
    }
    const Object &other = kept[first->second];
    const std::string what = fmt::format("{} {}", kindOf(object.kind), object.name);
    const std::string where = fmt::format("{}:{}", other.origin.file, other.origin.line);
    // Texts may differ where words do not.
    if (other.text == object.text)
      model.changed.push_back({object.origin, what, "taken once, it is the same as in " + where});
    else if (essenceOf(other.text) == essenceOf(object.text))
      model.changed.push_back(
          {object.origin, what,
           fmt::format("taken once, from {}: comments, texts or blanks differ", where)});
    else
      model.leftOut.push_back(
          {object.origin, what,
           fmt::format("another {} of this name stands in {}; import only one of the files, or "
                       "rename one of them",
                       kindOf(other.kind), where)});
  }
  model.objects = std::move(kept);
}

bool sameTask(const Task &a, const Task &b) {
  return a.priority == b.priority && a.interval == b.interval && a.event == b.event &&
         a.status == b.status && a.programs == b.programs;
}

void takeTasksOnce(Model &model) {
  std::vector<Task> kept;
  std::map<std::string, size_t> byName;
  for (Task &task : model.tasks) {
    const auto [first, isNew] = byName.try_emplace(lowerCase(task.name), kept.size());
    if (isNew) {
      kept.push_back(std::move(task));
      continue;
    }
    const Task *other = &kept[first->second];
    const std::string where = fmt::format("{}:{}", other->origin.file, other->origin.line);
    if (sameTask(*other, task))
      model.changed.push_back(
          {task.origin, "task " + task.name, "taken once, it is the same as in " + where});
    else
      model.leftOut.push_back(
          {task.origin, "task " + task.name, "another task of this name stands in " + where});
  }
  model.tasks = std::move(kept);
}

/// Whether a name is declared by the word: it begins a declaration, and `:`, `,` or AT follows it.
bool declares(std::string_view text, const std::vector<StWord> &words, size_t i) {
  const auto textOf = [&](size_t at) {
    return at < words.size()
               ? lowerCase(text.substr(words[at].begin, words[at].end - words[at].begin))
               : std::string();
  };
  static constexpr std::array<std::string_view, 5> kBefore = {";", ",", "(", "struct", "constant"};
  const std::string before = i == 0 ? std::string() : textOf(i - 1);
  if (!before.starts_with("var") && before != "retain" && before != "persistent" &&
      std::find(kBefore.begin(), kBefore.end(), before) == kBefore.end() && before != "program" &&
      before != "function" && before != "function_block" && before != "type" && before != "action")
    return false;
  const std::string next = textOf(i + 1);
  if (before == "program" || before == "function" || before == "function_block" ||
      before == "action")
    return true;
  return next == "at" || next == "," || (next == ":" && textOf(i + 2) != "=");
}

std::string freeName(const std::string &word, const std::set<std::string> &used) {
  std::string name = word + "_";
  for (size_t n = 1; used.contains(lowerCase(name)); ++n)
    name = fmt::format("{}_{}", word, n);
  return name;
}

/// All names of the sources in lower case, and of those that are reserved where they are declared.
void collect(const Model &model, std::set<std::string> &used,
             std::map<std::string, Remark> &reserved) {
  for (const Object &object : model.objects) {
    const std::vector<StWord> words = wordsOf(object.text);
    for (size_t i = 0; i < words.size(); ++i) {
      if (words[i].kind != StWord::Kind::Name)
        continue;
      const std::string spelling =
          object.text.substr(words[i].begin, words[i].end - words[i].begin);
      const std::string name = lowerCase(spelling);
      used.insert(name);
      if (std::find(kReservedHere.begin(), kReservedHere.end(), name) != kReservedHere.end() &&
          declares(object.text, words, i))
        reserved.try_emplace(name, Remark{object.origin, spelling, {}});
    }
  }
}

} // namespace

bool isProgram(const Object &object) {
  if (object.kind != ObjectKind::Pou)
    return false;
  const std::vector<StWord> words = wordsOf(object.text);
  return !words.empty() &&
         equalIgnoringCase(
             std::string_view(object.text).substr(0, words.front().end).substr(words.front().begin),
             "PROGRAM");
}

void takeOnce(Model &model) {
  takeObjectsOnce(model);
  takeTasksOnce(model);
}

void renameReserved(Model &model) {
  std::set<std::string> used;
  std::map<std::string, Remark> reserved;
  collect(model, used, reserved);
  if (reserved.empty())
    return;
  std::map<std::string, std::string> names;
  for (auto &[word, remark] : reserved) {
    const std::string name = freeName(remark.object, used);
    used.insert(lowerCase(name));
    names[word] = name;
    remark.text = fmt::format("became {} everywhere: the word is reserved here", name);
    model.changed.push_back(remark);
  }
  const auto by = [&](const StWord &word, std::string_view text) {
    const auto name = word.kind == StWord::Kind::Name ? names.find(lowerCase(text)) : names.end();
    return name == names.end() ? std::string() : name->second;
  };
  for (Object &object : model.objects) {
    object.text = replaceWords(object.text, by);
    object.name = replaceWords(object.name, by);
  }
  for (Task &task : model.tasks) {
    for (std::string &program : task.programs)
      program = replaceWords(program, by);
    task.event = replaceWords(task.event, by);
  }
  for (IoChannel &channel : model.channels)
    channel.name = replaceWords(channel.name, by);
}

} // namespace stc::import
