#include "workbench/report/turnable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/io/file.hpp"
#include "workbench/report/sections.hpp"
#include "workbench/report/text.hpp"
#include "workbench/report/turnable_script.hpp"

namespace beadwork::report {

namespace {

constexpr std::size_t most_bytes = 9'000'000, most_fields = 4;

template <class T>
std::string packed(const std::vector<T>& numbers) {
  return base64(numbers.data(), numbers.size() * sizeof(T));
}

/// The program of three.js as it was installed with this one; empty where it was not.
std::string three_js() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path place = (program.parent_path() / "../share/beadwork/three.min.js").lexically_normal();
  return std::filesystem::is_regular_file(place, error) ? read_text(place, 1 << 24) : "";
}

/// The fields of the first frame, at most some.
std::vector<const record::FieldValues*> fields_of(const record::Frame& frame) {
  std::vector<const record::FieldValues*> fields;
  for (const record::FieldValues& field : frame.fields)
    if (fields.size() < most_fields) fields.push_back(&field);
  return fields;
}

class Packer {
 public:
  Packer(const Run& run, const Stage& stage, const std::vector<record::Frame>& frames)
      : run_(run), stage_(stage), first_(frames.front()), box_(box_at_rest(frames.front())) {
    for (std::size_t i = 0; i < first_.id.size(); ++i)
      if (first_.radius[i] > 0) row_[first_.id[i]] = kept_.size(), kept_.push_back(i);  // walls have no radius
    if (row_.empty()) return;
    for (const std::size_t k : chosen_of(frames)) frames_.push_back(&frames[k]);
  }
  bool is_empty() const { return frames_.empty(); }

  Json data() const {
    const Vec3 centre = 0.5 * (box_.low + box_.high), size = box_.size();
    const Scale scale = readable("m", size.maxCoeff());
    Json json{{"elements", kept_.size()},
              {"centre", {centre.x(), centre.y(), centre.z()}},
              {"size", {size.x(), size.y(), size.z()}},
              {"factor", scale.factor},
              {"unit", scale.unit},
              {"view", axis_of(stage_.views.front().camera)}};
    std::vector<float> radius, rest;
    std::vector<std::int32_t> id;
    std::vector<std::uint8_t> color;
    for (const std::size_t i : kept_) {
      radius.push_back(static_cast<float>(first_.radius[i]));
      id.push_back(static_cast<std::int32_t>(first_.id[i]));
      for (int c = 0; c < 3; ++c) rest.push_back(static_cast<float>(at_rest(first_, i)[c] - centre[c]));
      const Color c = color_of(first_.id[i]);
      for (const float part : {c.red, c.green, c.blue})
        color.push_back(static_cast<std::uint8_t>(std::lround(255 * part)));
    }
    json["radius"] = packed(radius);
    json["rest"] = packed(rest);
    json["id"] = packed(id);
    json["color"] = packed(color);
    json["fields"] = Json::array();
    for (const record::FieldValues* field : fields_of(first_))
      json["fields"].push_back({{"name", (field->is_length ? "length of " : "") + spaced(field->name)},
                                {"unit", field->unit == "1" ? "" : field->unit}});
    json["frames"] = Json::array();
    for (const record::Frame* frame : frames_) json["frames"].push_back(packed_frame(*frame, centre));
    return json;
  }

 private:
  std::size_t bytes_of_frame() const { return kept_.size() * 4 * (3 + fields_of(first_).size()) * 4 / 3; }

  std::vector<std::size_t> chosen_of(const std::vector<record::Frame>& frames) const {
    const std::size_t room =
        std::clamp<std::size_t>(most_bytes / std::max<std::size_t>(1, bytes_of_frame()), 1, frames.size());
    std::vector<std::size_t> some;
    for (std::size_t k = 0; k < room; ++k)
      some.push_back(room == 1 ? frames.size() - 1 : k * (frames.size() - 1) / (room - 1));
    return some;
  }

  static std::string axis_of(const Camera& camera) {
    const Vec3 along = camera.right.cross(camera.up).cwiseAbs();
    return along.x() > 0.5 ? "x" : along.y() > 0.5 ? "y" : "z";
  }

  Color color_of(std::int64_t id) const {
    const auto found = stage_.element_color.find(id);
    return found == stage_.element_color.end() ? palette::body : found->second;
  }

  std::string label_of(const record::Frame& frame) const {
    const std::string loading = loading_at(run_, frame.head);
    const std::string step = "step " + count(frame.head.step);
    return loading.empty() ? step : loading + ", " + step;
  }

  Json packed_frame(const record::Frame& frame, const Vec3& centre) const {
    std::vector<float> position(3 * kept_.size(), NAN);
    const std::vector<const record::FieldValues*> wanted = fields_of(first_);
    std::vector<std::vector<float>> fields(wanted.size(), std::vector<float>(kept_.size(), NAN));
    std::vector<const record::FieldValues*> own(wanted.size(), nullptr);
    for (std::size_t k = 0; k < wanted.size(); ++k)
      for (const record::FieldValues& field : frame.fields)
        if (field.name == wanted[k]->name) own[k] = &field;
    for (std::size_t i = 0; i < frame.id.size(); ++i) {
      const auto row = row_.find(frame.id[i]);
      if (row == row_.end()) continue;
      for (int c = 0; c < 3; ++c)
        position[3 * row->second + static_cast<std::size_t>(c)] = static_cast<float>(frame.position[i][c] - centre[c]);
      for (std::size_t k = 0; k < fields.size(); ++k)
        if (own[k]) fields[k][row->second] = static_cast<float>(own[k]->values[i]);
    }
    Json json{{"label", label_of(frame)}, {"position", packed(position)}, {"fields", Json::array()}};
    for (const auto& field : fields) json["fields"].push_back(packed(field));
    add_bonds(frame, json);
    return json;
  }

  // Those of an interface, and whatever is no longer intact.
  void add_bonds(const record::Frame& frame, Json& json) const {
    std::vector<std::uint32_t> ends;
    std::vector<std::uint8_t> state;
    for (const record::Bonds& bonds : frame.bonds) {
      const bool whole =
          std::find(stage_.interfaces.begin(), stage_.interfaces.end(), bonds.family) != stage_.interfaces.end();
      for (std::size_t b = 0; b < bonds.ends.size(); ++b) {
        if (!whole && bonds.state[b] == State::intact) continue;
        const auto i = row_.find(frame.id[static_cast<std::size_t>(bonds.ends[b][0])]);
        const auto j = row_.find(frame.id[static_cast<std::size_t>(bonds.ends[b][1])]);
        if (i == row_.end() || j == row_.end()) continue;
        ends.insert(ends.end(), {static_cast<std::uint32_t>(i->second), static_cast<std::uint32_t>(j->second)});
        state.push_back(static_cast<std::uint8_t>(bonds.state[b]));
      }
    }
    json["ends"] = packed(ends);
    json["state"] = packed(state);
  }

  const Run& run_;
  const Stage& stage_;
  const record::Frame& first_;
  Box box_;
  std::unordered_map<std::int64_t, std::size_t> row_;  // of an element's id among those that are kept
  std::vector<std::size_t> kept_;                      // rows of the first frame
  std::vector<const record::Frame*> frames_;
};

constexpr const char* page = R"html(<div id="turnable" class="turnable">
<div class="controls">
<label>frame <input type="range" name="frame" min="0" step="1"></label> <b class="when"></b>
<label>show <select name="what"><option value="bodies">elements</option><option value="both">bonds over elements</option><option value="cracks">damaged bonds alone</option></select></label>
<label>colour <select name="color"><option value="set">sets</option><option value="state">state of their bonds</option></select></label>
<label>cut <select name="cut"><option>no</option><option>x</option><option>y</option><option>z</option></select> <input type="range" name="at" min="0" max="1000" value="500"></label>
<span>along <button data-along="x">x</button> <button data-along="y">y</button> <button data-along="z">z</button></span>
</div>
<div class="stage"></div>
<div class="bar"><span class="low"></span><i></i><span class="high"></span></div>
<p class="info"></p>
</div>
)html";

}  // namespace

std::string turnable(Run& run, const Stage& stage, const std::vector<record::Frame>& frames) {
  if (frames.empty()) return "";
  const std::string three = three_js();
  if (three.empty()) {
    run.notes.emplace_back("three.js is not installed (Debian: libjs-three), so the specimen cannot be turned here.");
    return "";
  }
  const Packer packer(run, stage, frames);
  if (packer.is_empty()) return "";
  std::string json = packer.data().dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at)) json.replace(at, 2, "<\\/");
  return section("The specimen, to be turned", std::string(page) +
                                                   "<script type=\"application/json\" id=\"turnable-data\">" + json +
                                                   "</script>\n<script>" + three + "</script>\n<script>" +
                                                   std::string(turnable_script) + "</script>\n");
}

}  // namespace beadwork::report
