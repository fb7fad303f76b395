#include "compiler/import/twincat_project.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/libraries.hpp"
#include "compiler/import/project_files.hpp"
#include "compiler/import/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace stc::import {

namespace twincat_project {
namespace {

constexpr std::string_view kPublished = "Beckhoff's documentation of the NC axis parameters";

/// Ratios are written as numbers of increments and units; both are made whole by at most this.
constexpr double kLargestScale = 1e9;
constexpr double kLargestUnits = 32767; ///< iRatioTechUnitsNum is an INT

std::optional<double> numberOf(const pugi::xml_attribute &attribute) {
  const std::string_view text = attribute.as_string();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// The axes of one file.
class AxisReader {
public:
  AxisReader(const std::string &file, const XmlDocument &document, Model &model)
      : file_(file), document_(document), model_(model) {}

  /// `folder`: where files of the axes lie, from that of this file.
  void readNc(const pugi::xml_node &nc, const std::string &folder) {
    for (const pugi::xml_node &axis : nc.children("Axis")) {
      const std::string_view elsewhere = axis.attribute("File").as_string();
      if (elsewhere.empty())
        readAxis(axis);
      else
        model_.references.push_back(
            {withSlashes(folder + std::string(elsewhere)), {file_, document_.lineOf(axis)}});
    }
  }

  void readAxis(const pugi::xml_node &axis) {
    const std::string given = axis.child("Name").text().as_string();
    const std::string shown = given.empty() || given == "__FILENAME__" ? stemOf(file_) : given;
    DriveSetup drive;
    drive.name = asIdentifier(shown);
    drive.origin = {file_, document_.lineOf(axis)};
    if (drive.name != shown)
      model_.changed.push_back({drive.origin, fmt::format("axis `{}`", shown),
                                fmt::format("it is called {} here", drive.name)});
    DriveGroupSetup &group = groupOf(drive.origin);
    for (const DriveSetup &each : group.drives)
      if (stride::common::lowerCase(each.name) == stride::common::lowerCase(drive.name))
        return model_.leftOut.push_back({drive.origin, fmt::format("axis {}", drive.name),
                                         "there is another axis of this name"});
    drive.parameters.push_back({"wDriveId", std::to_string(group.drives.size() + 1),
                                Certainty::Guessed, "counted: axes of the NC have no such number"});
    addScaling(axis.child("Encoder").child("EncPara"), drive);
    addLimits(axis.child("Encoder").child("EncPara"), drive);
    addDynamics(axis.child("AxisPara"), drive);
    group.drives.push_back(std::move(drive));
  }

private:
  DriveGroupSetup &groupOf(const Origin &origin) {
    constexpr std::string_view kBus = "NC";
    for (BusSetup &bus : model_.buses)
      if (bus.name == kBus)
        return bus.groups.front();
    BusSetup bus;
    bus.name = kBus;
    bus.origin = origin;
    DriveGroupSetup group;
    group.name = "NC_Axes";
    group.origin = origin;
    bus.groups.push_back(std::move(group));
    model_.buses.push_back(std::move(bus));
    return model_.buses.back().groups.front();
  }

  /// Units per increment, a fraction; ours is increments per units, both whole.
  static void addScaling(const pugi::xml_node &encoder, DriveSetup &drive) {
    const std::optional<double> units = numberOf(encoder.attribute("ScaleFactorNumerator"));
    const std::optional<double> increments =
        encoder.attribute("ScaleFactorDenominator")
            ? numberOf(encoder.attribute("ScaleFactorDenominator"))
            : std::optional<double>(1.0);
    if (units && increments && *units > 0 && *increments > 0)
      for (double scale = 1; scale <= kLargestScale; scale *= 10) {
        const double whole = *units * scale;
        const double denominator = *increments * scale;
        if (std::abs(whole - std::round(whole)) > 1e-9 * whole ||
            std::abs(denominator - std::round(denominator)) > 1e-9 * denominator ||
            std::round(whole) < 1 || std::round(whole) > kLargestUnits ||
            denominator > static_cast<double>(UINT32_MAX))
          continue;
        const long long common = std::gcd(std::llround(denominator), std::llround(whole));
        drive.parameters.push_back({"dwRatioTechUnitsDenom",
                                    std::to_string(std::llround(denominator) / common),
                                    Certainty::Sure, std::string(kPublished)});
        drive.parameters.push_back({"iRatioTechUnitsNum",
                                    std::to_string(std::llround(whole) / common), Certainty::Sure,
                                    std::string(kPublished)});
        return;
      }
    drive.parameters.push_back({"dwRatioTechUnitsDenom", "10000", Certainty::Missing,
                                "the encoder's scaling factor is not in the file"});
  }

  void addLimits(const pugi::xml_node &encoder, DriveSetup &drive) {
    const pugi::xml_node low = encoder.child("SoftEndMinControl");
    const pugi::xml_node high = encoder.child("SoftEndMaxControl");
    const bool lowOn = low.attribute("Enable").as_bool();
    const bool highOn = high.attribute("Enable").as_bool();
    const std::optional<double> least = numberOf(low.attribute("Range"));
    const std::optional<double> most = numberOf(high.attribute("Range"));
    if (least)
      addNumber("fSWLimitNegative", *least, drive);
    if (most)
      addNumber("fSWLimitPositive", *most, drive);
    if (lowOn && highOn && least && most)
      drive.parameters.push_back(
          {"bSWLimitEnable", "true", Certainty::Sure, std::string(kPublished)});
    else if (lowOn || highOn)
      model_.leftOut.push_back({drive.origin, fmt::format("axis {}", drive.name),
                                "only one of its two software limits is on; ours are on together"});
  }

  static void addDynamics(const pugi::xml_node &parameters, DriveSetup &drive) {
    const pugi::xml_node dynamic = parameters.child("Dynamic");
    if (const auto value = numberOf(parameters.child("Velo").attribute("Maximum")))
      addNumber("fSWMaxVelocity", *value, drive);
    if (const auto value = numberOf(dynamic.attribute("AccelerationMaximum")))
      addNumber("fSWMaxAcceleration", *value, drive);
    if (const auto value = numberOf(dynamic.attribute("DecelerationMaximum")))
      addNumber("fSWMaxDeceleration", *value, drive);
  }

  static void addNumber(std::string key, double value, DriveSetup &drive) {
    drive.parameters.push_back(
        {std::move(key), tomlNumber(value), Certainty::Sure, std::string(kPublished)});
  }

  const std::string &file_;
  const XmlDocument &document_;
  Model &model_;
};

/// What follows the last `^` of the path of a tree: `TINC^NC-Task 1 SAF^Axes^Feed`: Feed.
std::string_view lastOf(std::string_view path) {
  const size_t caret = path.find_last_of('^');
  return caret == std::string_view::npos ? path : path.substr(caret + 1);
}

/// Links of axes with variables stand at different depths.
void readLinks(const std::string &file, const XmlDocument &document, const pugi::xml_node &owner,
               Model &model) {
  constexpr std::string_view kMember = ".NcToPlc";
  const std::string_view axis = owner.attribute("Name").as_string();
  if (!axis.starts_with("TINC^"))
    return;
  for (const pugi::xml_node &link : owner.children("Link")) {
    std::string_view variable = lastOf(link.attribute("VarA").as_string());
    const std::string_view other = link.attribute("VarB").as_string();
    // TwinCAT keeps links that it could not restore; RestoreInfo says so.
    if (!variable.ends_with(kMember) || !other.ends_with("ToPlc") || link.attribute("RestoreInfo"))
      continue;
    variable.remove_suffix(kMember.size());
    model.axisLinks.push_back(
        {std::string(variable), asIdentifier(lastOf(axis)), {file, document.lineOf(link)}});
  }
}

class LinkWalker : public pugi::xml_tree_walker {
public:
  LinkWalker(const std::string &file, const XmlDocument &document, Model &model)
      : file_(file), document_(document), model_(model) {}
  bool for_each(pugi::xml_node &node) override {
    if (std::string_view(node.name()) == "OwnerB")
      readLinks(file_, document_, node, model_);
    return true;
  }

private:
  const std::string &file_;
  const XmlDocument &document_;
  Model &model_;
};

/// Stride's stand-ins for libraries of TwinCAT are seen in projects that name them.
void addLibrary(LibraryReference library, Model &model) {
  for (const std::string_view each : {"Tc2_MC2", "Tc2_System"})
    if (library.name == each && std::ranges::find(model.named, each) == model.named.end())
      model.named.emplace_back(each);
  model.libraries.push_back(std::move(library));
}

void readProjectItem(const std::string &file, const XmlDocument &document,
                     const pugi::xml_node &item, Model &model) {
  const std::string_view element = item.name();
  const std::string include = item.attribute("Include").as_string();
  const Origin origin{file, document.lineOf(item)};
  const bool excluded = item.child("ExcludeFromBuild").text().as_bool();
  if (element == "Compile")
    (excluded ? model.excluded : model.references).push_back({withSlashes(include), origin});
  if (element == "Compile" && excluded)
    model.leftOut.push_back({origin, include, "the project excludes it from the build"});
  if (element == "PlaceholderReference")
    addLibrary({include,
                libraryNamed(item.child("DefaultResolution").text().as_string(), origin).version,
                origin,
                {}},
               model);
  else if (element == "LibraryReference")
    addLibrary(libraryNamed(include, origin), model);
}

} // namespace
} // namespace twincat_project

void readPlcProject(const std::string &file, const XmlDocument &document, Model &model) {
  for (const pugi::xml_node &group : document.tree.document_element().children("ItemGroup"))
    for (const pugi::xml_node &item : group.children())
      twincat_project::readProjectItem(file, document, item, model);
}

void readSystemProject(const std::string &file, const XmlDocument &document, Model &model) {
  const pugi::xml_node root = document.tree.document_element();
  twincat_project::AxisReader axes(file, document, model);
  const pugi::xml_node nc = root.child("Project").child("Motion").child("NC");
  if (nc.attribute("File"))
    model.references.push_back(
        {withSlashes(fmt::format("_Config/NC/{}", nc.attribute("File").as_string())),
         {file, document.lineOf(nc)}});
  axes.readNc(nc, "_Config/NC/Axes/");
  axes.readNc(root.child("NC"), "Axes/");
  for (const pugi::xml_node &axis : root.children("Axis"))
    axes.readAxis(axis);
  for (const pugi::xml_node &plc : root.child("Project").child("Plc").children("Project")) {
    const pugi::xml_attribute project = plc.attribute("PrjFilePath");
    const pugi::xml_attribute elsewhere = plc.attribute("File");
    if (project)
      model.references.push_back({withSlashes(project.as_string()), {file, document.lineOf(plc)}});
    else if (elsewhere)
      model.references.push_back({withSlashes(fmt::format("_Config/PLC/{}", elsewhere.as_string())),
                                  {file, document.lineOf(plc)}});
  }
  if (const pugi::xml_attribute project = root.child("Project").attribute("PrjFilePath"))
    model.references.push_back(
        {withSlashes(project.as_string()), {file, document.lineOf(root.child("Project"))}});
  twincat_project::LinkWalker walker(file, document, model);
  document.tree.document_element().traverse(walker);
}

} // namespace stc::import
