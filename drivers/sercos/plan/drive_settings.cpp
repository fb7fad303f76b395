#include "drivers/sercos/plan/drive_settings.hpp"

#include "runtime/common/setup_text.hpp"

#include <algorithm>
#include <charconv>

namespace stride::sercos {
namespace {

using common::linesOf;

/// IDNs that the driver writes from what it knows, and of stride.toml what decides about them.
struct OwnedRow {
  Idn idn;
  std::string_view by;
};
constexpr std::string_view kTimes = "the cycle and the times of the ring";
constexpr std::string_view kTelegrams = "`wControlType`, `additional` and `additional_sent`";
constexpr std::string_view kCommand = "the driver: it is a procedure command";
constexpr std::array<OwnedRow, 18> kOwned = {{
    {idns::kControlUnitCycle, kTimes},
    {idns::kCommunicationCycle, kTimes},
    {idns::kAtStart, kTimes},
    {idns::kFeedbackSampling, kTimes},
    {idns::kCommandValid, kTimes},
    {idns::kMdtStart, kTimes},
    {idns::kPlaceInMdt, kTelegrams},
    {idns::kMdtLength, kTelegrams},
    {idns::kTelegramType, kTelegrams},
    {idns::kAtList, kTelegrams},
    {idns::kMdtList, kTelegrams},
    {idns::kPrimaryMode, kTelegrams},
    {idns::kSecondaryMode1, kTelegrams},
    {idns::kSecondaryMode2, kTelegrams},
    {idns::kCheckPhase3, kCommand},
    {idns::kCheckPhase4, kCommand},
    {idns::kDriveHoming, kCommand},
    {idns::kProbing, kCommand},
}};

/// IDNs that drives take no later than in that phase. [IEC 61491]
struct LatestRow {
  Idn idn;
  uint8_t phase;
};
constexpr std::array<LatestRow, 14> kLatest = {{
    {idns::kSecondaryMode3, 3},
    {idns::kVelocityScaling, 3},
    {idns::kVelocityFactor, 3},
    {idns::kVelocityExponent, 3},
    {idns::kPositionScaling, 3},
    {idns::kLinearFactor, 3},
    {idns::kLinearExponent, 3},
    {idns::kRotationalResolution, 3},
    {idns::kTorqueScaling, 3},
    {idns::kTorqueFactor, 3},
    {idns::kTorqueExponent, 3},
    {idns::kModulo, 3},
    {idns::kPositionPolarity, 3},
    {idns::kAccelerationScaling, 3},
}};

class Reader {
public:
  Reader(const common::SetupParameters &given, DriveSettings &settings)
      : given_(given), settings_(settings) {}

  void readLists() {
    for (size_t i = 0; i < kLists; ++i) {
      const std::string key = "idn.phase" + std::to_string(i + 2);
      for (const std::string &line : linesOf(given_.text(key))) {
        IdnValue value;
        std::string error;
        if (!parseIdnValue(line, value, error) || !allowed(value.idn, i, error))
          refuse(line, key, error);
        else
          settings_.lists[i].push_back(std::move(value));
      }
    }
  }

  void readLocked() {
    for (const std::string &line : linesOf(given_.text("locked"))) {
      const auto idn = parseIdn(line);
      if (!idn) {
        refuse(line, "locked", "an IDN is written as S-0-0041 or P-0-0001");
        continue;
      }
      settings_.locked.push_back(*idn);
      for (size_t i = 0; i < kLists; ++i)
        for (const IdnValue &value : settings_.lists[i])
          if (value.idn == *idn)
            refuse(line, "locked", "`idn.phase" + std::to_string(i + 2) + "` writes it");
    }
  }

  std::vector<CyclicObject> readObjects(const char *key) {
    std::vector<CyclicObject> objects;
    for (const std::string &line : linesOf(given_.text(key))) {
      const size_t colon = line.find(':');
      const auto idn = parseIdn(std::string_view(line).substr(0, colon));
      const std::string_view length = colon == std::string::npos
                                          ? std::string_view()
                                          : std::string_view(line).substr(colon + 1);
      if (!idn || (length != "2" && length != "4"))
        refuse(line, key, "an entry is an IDN and its length, 2 or 4 bytes: \"S-0-0189:4\"");
      else
        objects.push_back({*idn, static_cast<uint8_t>(length[0] - '0')});
    }
    return objects;
  }

private:
  bool allowed(Idn idn, size_t list, std::string &error) const {
    for (const OwnedRow &row : kOwned)
      if (row.idn == idn) {
        error = "what is written there is the matter of " + std::string(row.by);
        return false;
      }
    for (const LatestRow &row : kLatest)
      if (row.idn == idn && list + 2 > row.phase) {
        error = "drives take it in phase " + std::to_string(row.phase) + " at the latest";
        return false;
      }
    return true;
  }

  void refuse(const std::string &line, const std::string &key, const std::string &error) {
    settings_.errors.push_back("`" + line + "` in `" + key + "`: " + error);
  }

  const common::SetupParameters &given_;
  DriveSettings &settings_;
};

} // namespace

bool isOwnedByDriver(Idn idn) {
  return std::any_of(kOwned.begin(), kOwned.end(),
                     [idn](const OwnedRow &row) { return row.idn == idn; });
}

DriveSettings driveSettings(const common::SetupParameters &given, bool secondEncoder) {
  DriveSettings settings;
  settings.io = given.text("device_type") == "io";
  settings.profile = static_cast<PackProfile>(static_cast<int>(given.number("packprofile")));
  Reader reader(given, settings);
  reader.readLists();
  reader.readLocked();
  CyclicWish wish;
  wish.io = settings.io;
  wish.controlType = static_cast<uint8_t>(given.number("wControlType"));
  for (size_t i = 0; i < wish.send.size(); ++i) {
    const std::string place = std::to_string(i + 1);
    wish.send[i] = static_cast<uint16_t>(given.number("wCyclicDataS" + place));
    wish.receive[i] = static_cast<uint16_t>(given.number("wCyclicDataR" + place));
  }
  wish.more = reader.readObjects("additional");
  wish.moreSent = reader.readObjects("additional_sent");
  const CyclicObject second{idns::kPositionFeedback2, 4};
  if (secondEncoder && std::find(wish.more.begin(), wish.more.end(), second) == wish.more.end())
    wish.more.push_back(second);
  settings.cyclic = planCyclic(wish, settings.errors);
  for (std::string &fault : profileFaults(settings.profile, given, settings.cyclic))
    settings.errors.push_back(std::move(fault));
  for (const std::vector<IdnValue> &list : settings.lists)
    for (std::string &fault : profileFaults(settings.profile, list))
      settings.errors.push_back(std::move(fault));
  return settings;
}

} // namespace stride::sercos
