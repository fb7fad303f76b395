#include "compiler/doc/html.hpp"

#include "runtime/common/text.hpp"

#include <cctype>
#include <map>
#include <set>

namespace stc::doc {

using stride::common::escapedMarkup;

namespace {

constexpr const char *kStyle =
    R"css(:root { color-scheme: light dark; --line: #8884; --soft: #8882; --link: #0b63c5; }
@media (prefers-color-scheme: dark) { :root { --link: #7ab8ff; } }
body { font: 16px/1.5 system-ui, sans-serif; margin: 0; display: grid; grid-template-columns: 16rem minmax(0, 52rem); }
nav { border-right: 1px solid var(--line); padding: 1rem; height: 100vh; box-sizing: border-box; overflow: auto;
      position: sticky; top: 0; }
nav ul { list-style: none; margin: 0; padding: 0; font-size: 0.9rem; }
nav input { width: 100%; box-sizing: border-box; font: inherit; padding: 0.3rem; margin-bottom: 0.8rem; }
main { padding: 1rem 2rem 4rem; }
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
section { border-top: 1px solid var(--line); padding-top: 0.5rem; margin-top: 1.5rem; }
section section { border: 0; margin-left: 1.5rem; }
h2, h3 { font-family: ui-monospace, monospace; font-size: 1.15rem; margin: 0.4rem 0; }
h3 { font-size: 1rem; }
.kind { font: 0.8rem system-ui, sans-serif; opacity: 0.7; margin-right: 0.6rem; }
.suffix { font-weight: normal; }
table { border-collapse: collapse; width: 100%; font-size: 0.92rem; }
td, th { border-bottom: 1px solid var(--soft); padding: 0.2rem 0.8rem 0.2rem 0; text-align: left; vertical-align: top; }
td.name, td.type { font-family: ui-monospace, monospace; white-space: nowrap; }
figure { margin: 1rem 0; }
figure img { width: 100%; background: #fff; border-radius: 4px; }
figcaption { font-size: 0.92rem; }
caption { text-align: left; font-weight: 600; padding-top: 0.6rem; }
@media (max-width: 50rem) { body { display: block; } nav { position: static; height: auto; max-height: 40vh; } }
)css";

constexpr const char *kSearch = R"js('use strict';
(function () {
  const input = document.getElementById('search');
  const list = document.getElementById('found');
  const contents = document.getElementById('contents');
  input.addEventListener('input', function () {
    const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
    contents.hidden = words.length > 0;
    list.replaceChildren();
    if (words.length === 0) return;
    const rank = function (e) {
      const name = e[0].toLowerCase();
      return name === words[0] ? 0 : name.startsWith(words[0]) ? 1 : name.includes(words[0]) ? 2 : 3;
    };
    const hits = index.filter(function (e) {
      const text = (e[0] + ' ' + e[2] + ' ' + e[3] + ' ' + (e[4] || '')).toLowerCase();
      return words.every(function (w) { return text.includes(w); });
    });
    hits.sort(function (a, b) { return rank(a) - rank(b) || a[0].localeCompare(b[0]); });
    for (const e of hits.slice(0, 100)) {
      const item = document.createElement('li');
      const link = document.createElement('a');
      link.href = e[1];
      link.textContent = e[0];
      link.title = e[2] + ': ' + e[3];
      item.append(link);
      list.append(item);
    }
    if (hits.length === 0) list.textContent = 'nothing found';
  });
})();
)js";

/// A JavaScript string literal that may stand in a script of its own file.
std::string literal(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + '"';
}

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class Writer {
public:
  Writer(const std::string &title, const std::vector<Module> &modules)
      : title_(title), modules_(modules) {
    for (const Module &module : modules) {
      std::set<std::string> used;
      for (const Entry &entry : module.entries) {
        name(entry, used);
        places_.try_emplace(entry.name, fileOf(module) + "#" + ids_.at(&entry));
      }
    }
  }

  std::vector<Page> pages() {
    std::vector<Page> pages = {
        {"style.css", kStyle}, {"search.js", searchIndex()}, {"index.html", indexPage()}};
    for (const Module &module : modules_)
      pages.push_back({fileOf(module), modulePage(module)});
    return pages;
  }

private:
  static std::string fileOf(const Module &module) { return module.name + ".html"; }

  std::string searchIndex() {
    std::string out = "const index = [\n";
    for (const Module &module : modules_) {
      for (const Entry &entry : module.entries) {
        row(out, module, entry);
        for (const Entry &part : entry.parts)
          row(out, module, part);
      }
    }
    return out + "];\n" + kSearch;
  }

  /// A name, where it leads, what it is, a sentence on it, and what else the search looks through.
  void row(std::string &out, const Module &module, const Entry &entry) const {
    const std::string first = firstSentence(entry.text);
    std::string more = entry.text.substr(first.size());
    for (const Group &group : entry.groups)
      for (const Member &member : group.members)
        more += ' ' + member.name + ' ' + member.text;
    const std::string place = literal(fileOf(module) + "#" + ids_.at(&entry));
    const std::string what = literal(module.name + ", " + entry.kind);
    out += '[' + literal(entry.name) + ',' + place + ',' + what + ',' + literal(first) + ',' +
           literal(more) + "],\n";
    for (const std::string &alias : entry.aliases)
      out += '[' + literal(alias) + ',' + place + ',' + what + ",\"\"],\n";
  }

  /// Gives an entry and its parts the ids of their sections: their names, made different where a
  /// page has one name twice (a program and the variables of its file).
  void name(const Entry &entry, std::set<std::string> &used) {
    std::string id = entry.name;
    for (int i = 2; !used.insert(id).second; ++i)
      id = entry.name + "-" + std::to_string(i);
    ids_.emplace(&entry, id);
    for (const Entry &part : entry.parts)
      name(part, used);
  }

  [[nodiscard]] std::string page(const std::string &heading, const std::string &contents,
                                 const std::string &body) const {
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
           escapedMarkup(heading) +
           "</title>\n<link rel=\"stylesheet\" href=\"style.css\">\n</head>\n<body>\n<nav>\n"
           "<p><a href=\"index.html\">" +
           escapedMarkup(title_) +
           "</a></p>\n<input id=\"search\" type=\"search\" placeholder=\"Search\" "
           "aria-label=\"Search\">\n<ul id=\"found\"></ul>\n<ul id=\"contents\">\n" +
           contents + "</ul>\n</nav>\n<main>\n<h1>" + escapedMarkup(heading) + "</h1>\n" + body +
           "</main>\n<script src=\"search.js\"></script>\n</body>\n</html>\n";
  }

  std::string indexPage() {
    std::string contents;
    std::string body;
    for (const Module &module : modules_) {
      const std::string link = "<a href=\"" + escapedMarkup(fileOf(module)) + "\">" +
                               escapedMarkup(module.name) + "</a>";
      contents += "<li>" + link + "</li>\n";
      body += "<section>\n<h2>" + link + "</h2>\n" + paragraphs(module.text) + "<table>\n";
      for (const Entry &entry : module.entries)
        body += "<tr><td class=\"name\"><a href=\"" +
                escapedMarkup(fileOf(module) + "#" + ids_.at(&entry)) + "\">" +
                escapedMarkup(entry.name) + "</a></td><td>" +
                linked(firstSentence(entry.text), entry.name) + "</td></tr>\n";
      body += "</table>\n</section>\n";
    }
    return page(title_, contents, body);
  }

  std::string modulePage(const Module &module) {
    std::string contents;
    std::string body = paragraphs(module.text);
    for (const Entry &entry : module.entries) {
      contents += "<li><a href=\"#" + escapedMarkup(ids_.at(&entry)) + "\">" +
                  escapedMarkup(entry.name) + "</a></li>\n";
      body += section(entry, "h2");
    }
    return page(module.name, contents, body);
  }

  std::string section(const Entry &entry, const std::string &heading) {
    std::string out = "<section id=\"" + escapedMarkup(ids_.at(&entry)) + "\">\n<" + heading +
                      "><span class=\"kind\">" + escapedMarkup(entry.kind) + "</span>" +
                      escapedMarkup(entry.name);
    if (!entry.suffix.empty())
      out += " <span class=\"suffix\">" + linked(entry.suffix, entry.name) + "</span>";
    out += "</" + heading + ">\n" + paragraphs(entry.text, entry.name);
    for (const Group &group : entry.groups) {
      if (group.members.empty())
        continue;
      out += "<table>\n<caption>" + escapedMarkup(group.title) + "</caption>\n";
      for (const Member &member : group.members)
        out += "<tr><td class=\"name\">" + escapedMarkup(member.name) + "</td><td class=\"type\">" +
               linked(member.type, entry.name) +
               (member.init.empty() ? "" : escapedMarkup(" := " + member.init)) + "</td><td>" +
               linked(member.text, entry.name) + "</td></tr>\n";
      out += "</table>\n";
    }
    out += figure(entry);
    for (const Entry &part : entry.parts)
      out += section(part, "h3");
    return out + "</section>\n";
  }

  std::string figure(const Entry &entry) {
    if (entry.figure.empty())
      return {};
    return "<figure>\n<img src=\"" + escapedMarkup(entry.figure) + "\" alt=\"" +
           escapedMarkup(firstSentence(entry.caption)) + "\" loading=\"lazy\">\n<figcaption>" +
           linked(entry.caption, entry.name) + "</figcaption>\n</figure>\n";
  }

  /// Empty lines part paragraphs.
  std::string paragraphs(const std::string &text, const std::string &self = {}) {
    std::string out;
    for (size_t at = 0; at < text.size();) {
      size_t end = text.find("\n\n", at);
      if (end == std::string::npos)
        end = text.size();
      out += "<p>" + linked(text.substr(at, end - at), self) + "</p>\n";
      at = end + 2;
    }
    return out;
  }

  /// The text with links from the names of entries, but for `self`.
  std::string linked(const std::string &text, const std::string &self) {
    std::string out;
    for (size_t at = 0; at < text.size();) {
      size_t end = at;
      while (end < text.size() && isWord(text[end]))
        ++end;
      if (end == at) {
        out += escapedMarkup(text.substr(at++, 1));
        continue;
      }
      const std::string word = text.substr(at, end - at);
      const auto place = places_.find(word);
      if (place != places_.end() && word != self)
        out += "<a href=\"" + escapedMarkup(place->second) + "\">" + word + "</a>";
      else
        out += word;
      at = end;
    }
    return out;
  }

  const std::string &title_;
  const std::vector<Module> &modules_;
  std::map<const Entry *, std::string> ids_;  ///< of their sections
  std::map<std::string, std::string> places_; ///< name → page and anchor
};

} // namespace

std::vector<Page> htmlPages(const std::string &title, const std::vector<Module> &modules) {
  return Writer(title, modules).pages();
}

} // namespace stc::doc
