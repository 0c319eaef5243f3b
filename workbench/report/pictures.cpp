// The pictures of the specimen: which frames, how large, and their captions.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "workbench/report/sections.hpp"
#include "workbench/report/specimen.hpp"
#include "workbench/report/text.hpp"
#include "workbench/report/turnable.hpp"

namespace beadwork::report {

namespace {

constexpr int widest = 1120, tallest = 460;  ///< pixels

std::string swatch(const std::string& label, Color c) {
  return fmt::format("<span><i class=\"key disc\" style=\"background:{}\"></i>{}</span>", css(c), escaped(label));
}

/// A bar of a round length, about a sixth of the picture.
std::string scale_bar(const Camera& camera) {
  Real length = std::pow(10, std::floor(std::log10(camera.width / 6)));
  for (const Real nice : {5.0, 2.0})
    if (nice * length <= camera.width / 4) {
      length *= nice;
      break;
    }
  const Scale scale = readable("m", length);
  return fmt::format("<i class=\"scale\" style=\"width:{:.2f}%\"><b>{} {}</b></i>", 100 * length / camera.width,
                     number(length * scale.factor), scale.unit);
}

std::string picture(const Stage& stage, const View& view, const record::Frame& frame, const std::string& name) {
  // Views of one width share the bar under the last of them.
  const bool last = &view == &stage.views.back() || stage.views.back().camera.width != view.camera.width;
  const Image image = draw(stage, view, frame, width_in_pixels(stage, view, widest, tallest));
  const auto bytes = png(image);
  return fmt::format(
      "<div class=\"view\"><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\">{}</div>",
      base64(bytes.data(), bytes.size()), image.width, image.height, escaped(name + ", " + view.name),
      last ? scale_bar(view.camera) : "");
}

std::string states_of(const Counts& n) {
  if (n.elastic + n.softening + n.broken == 0) return "";
  const auto item = [](const char* kind, std::size_t many, Color c) {
    return swatch(count(static_cast<std::int64_t>(many)) + " " + kind, c);
  };
  return "<span class=\"states\">" + item("elastic", n.elastic, palette::elastic) +
         item("softening", n.softening, palette::softening) + item("broken", n.broken, palette::broken) + "</span>";
}

std::string figure_of(const Run& run, const Stage& stage, const record::Frame& frame, std::size_t place) {
  const std::string loading = loading_at(run, frame.head);
  const Scale scale = readable("s", frame.head.time);
  const std::string when =
      "step " + count(frame.head.step) + ", time " + number(frame.head.time * scale.factor) + " " + scale.unit;
  std::string out = fmt::format(
      "<figure class=\"frame\"><figcaption><span class=\"no\">{}</span><b>{}</b> <span "
      "class=\"when\">{}</span>{}</figcaption>",
      place, escaped(loading.empty() ? when : loading), loading.empty() ? "" : escaped(when),
      states_of(counts(stage, frame)));
  const Counts n = counts(stage, frame);
  for (const View& view : stage.views) {
    const bool nothing_yet = view.show == Show::bonds && stage.interfaces.empty() && n.softening + n.broken == 0;
    if (!nothing_yet) out += picture(stage, view, frame, run.scene + ", " + when);
  }
  return out + "</figure>\n";
}

std::string explanation(const Stage& stage, bool bonds) {
  std::string out = "<p>";
  for (const View& view : stage.views) {
    std::string sentence = view.name;
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    out += escaped(sentence) + (view.show == Show::bonds ? ", not deformed. " : ". ");
  }
  out += stage.magnification > 1 ? "Displacements are magnified " + number(stage.magnification) + " times."
                                 : "Displacements are true to scale.";
  out += "</p><div class=\"legend\">";
  if (bonds)
    out += swatch("elastic", palette::elastic) + swatch("softening", palette::softening) +
           swatch("broken", palette::broken);
  for (const Legend& set : stage.sets) out += swatch("set " + set.label, set.color);
  return out + "</div>";
}

std::vector<record::Frame> read_frames(Run& run, const std::vector<record::FrameHead>& heads) {
  std::vector<record::Frame> frames;
  for (const record::FrameHead& head : heads) {
    try {
      frames.push_back(run.recorded->read(head));
      if (const auto odd = static_cast<std::int64_t>(leave_out_odd(frames.back())); odd > 0)
        run.notes.push_back("In the frame of step " + count(head.step) + ", " + plural(odd, "element") +
                            (odd == 1 ? " has" : " have") +
                            " no place or size that can be drawn (no number, infinite, or far outside), and " +
                            (odd == 1 ? "was" : "were") + " left out.");
    } catch (const std::exception& problem) {
      run.notes.push_back("The frame of step " + count(head.step) + " cannot be read (" + problem.what() + ").");
    }
  }
  return frames;
}

std::map<std::string, std::vector<std::int64_t>> sets_of(Run& run) {
  try {
    return run.recorded->sets();
  } catch (const std::exception& problem) {
    run.notes.push_back("The sets of elements cannot be read, and share one colour (" + std::string(problem.what()) +
                        ").");
    return {};
  }
}

}  // namespace

std::vector<record::FrameHead> chosen(const std::vector<record::FrameHead>& all) {
  std::vector<record::FrameHead> flagged;
  std::copy_if(all.begin(), all.end(), std::back_inserter(flagged),
               [](const record::FrameHead& h) { return h.picture; });
  const std::vector<record::FrameHead>& from = flagged.empty() ? all : flagged;
  const std::size_t most = flagged.empty() ? 8 : 24;  // those that were asked for, up to what a page can hold
  if (from.size() <= most) return from;
  std::vector<record::FrameHead> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(from[k * (from.size() - 1) / (most - 1)]);
  return some;
}

namespace {

/// The still pictures are there without it.
std::string to_be_turned(Run& run, const Stage& stage, const std::vector<record::Frame>& frames) {
  try {
    return turnable(run, stage, frames);
  } catch (const std::exception& problem) {
    run.notes.push_back("The specimen cannot be turned (" + std::string(problem.what()) + ").");
    return "";
  }
}

}  // namespace

namespace {

/// The frames that can be drawn, and where from.
struct Scenery {
  std::vector<record::Frame> frames;
  Stage stage;
};

std::optional<Scenery> scenery_of(Run& run, const std::vector<record::FrameHead>& pictured, const std::string& wanted) {
  if (!run.recorded) return std::nullopt;
  if (pictured.empty()) {
    run.notes.emplace_back("run.h5 holds no frames, so there are no pictures of the specimen.");
    return std::nullopt;
  }
  Scenery scenery{read_frames(run, pictured), {}};
  std::vector<record::Frame>& frames = scenery.frames;
  const auto said = run.notes;  // of the first frame all has been said if it is among them
  std::vector<record::Frame> first = read_frames(run, {run.recorded->frames().front()});
  if (pictured.front().name == run.recorded->frames().front().name) run.notes = said;
  std::erase_if(frames, [](const record::Frame& f) { return f.position.empty(); });
  if (frames.empty()) return std::nullopt;
  const record::Frame rest = first.empty() || first.front().position.empty() ? frames.front() : first.front();
  for (record::Frame& frame : frames) complete_displacement(frame, rest);
  scenery.stage = set_up(rest, frames, sets_of(run), wanted.empty() ? wanted_view(frames) : wanted);
  return scenery;
}

std::string stills(const Run& run, const Scenery& scenery, const std::vector<record::FrameHead>& pictured) {
  const auto& [frames, stage] = scenery;
  const bool bonds = std::any_of(frames.begin(), frames.end(), [](const record::Frame& f) { return !f.bonds.empty(); });
  const double shape = stage.views.front().camera.width / stage.views.front().camera.height;
  std::string body =
      explanation(stage, bonds) + (shape > 2.2 ? "<div class=\"frames wide\">" : "<div class=\"frames\">");
  for (const record::Frame& frame : frames) {
    const auto head = std::find_if(pictured.begin(), pictured.end(),
                                   [&](const record::FrameHead& h) { return h.name == frame.head.name; });
    body += figure_of(run, stage, frame, static_cast<std::size_t>(head - pictured.begin()) + 1);
  }
  return body + "</div>";
}

}  // namespace

std::string still_pictures(Run& run, const std::vector<record::FrameHead>& pictured) {
  const auto scenery = scenery_of(run, pictured, "");
  return scenery ? stills(run, *scenery, pictured) : "";
}

std::string pictures(Run& run, const std::vector<record::FrameHead>& pictured, const std::string& wanted) {
  const auto scenery = scenery_of(run, pictured, wanted);
  if (!scenery) return "";
  const auto& [frames, stage] = *scenery;
  return section("The specimen", stills(run, *scenery, pictured)) + to_be_turned(run, stage, frames) +
         field_pictures(stage, frames);
}

}  // namespace beadwork::report
