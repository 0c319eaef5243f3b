#include "core/io/recorder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include "core/io/frame_file.hpp"
#include "core/io/h5.hpp"

namespace beadwork {

namespace {

namespace fs = std::filesystem;
using fs::path;

constexpr const char* one_file = "consolidated-";  // beginning of the name of a former run.h5 under frames/

std::string name_of(std::int64_t step) { return fmt::format("{:012}", step); }

// ---- what run.h5 says of the run as a whole

void write_meta(hid_t place, const RunMeta& meta) {
  const h5::Handle group = h5::make_group(place, "meta");
  h5::write_text(group.id(), "name", meta.name);
  h5::write_text(group.id(), "deck", meta.deck);
  h5::write_text(group.id(), "resolved", meta.resolved);
  h5::write_text(group.id(), "deck_sha256", meta.deck_sha256);
  h5::write_texts(group.id(), "overrides", meta.overrides);
  h5::write_texts(group.id(), "files", meta.files);
  h5::write_text(group.id(), "version", meta.version);
  h5::write_texts(group.id(), "plugins", meta.plugins);
  h5::write_text(group.id(), "packing", meta.packing);
  h5::set_attribute(group.id(), "threads", static_cast<std::int64_t>(meta.threads));
  h5::set_attribute(group.id(), "seed", static_cast<std::int64_t>(meta.seed));
}

void write_sets(hid_t place, const Domain& domain) {
  const h5::Handle group = h5::make_group(place, "sets");
  const auto id = domain.elements().column("id").view<const Index>();
  for (const auto& [name, set] : domain.sets()) {
    std::vector<Index> ids;
    for (const Index row : set) ids.push_back(id[row]);
    std::sort(ids.begin(), ids.end());
    h5::write_indices(group.id(), name, ids, 1, {"1", "Ids of the elements of the set"});
  }
}

void write_pairs(hid_t place, const Domain& domain) {
  if (domain.pairs().empty()) return;
  const h5::Handle group = h5::make_group(place, "pairs");
  const auto id = domain.elements().column("id").view<const Index>();
  for (const auto& [name, pairs] : domain.pairs()) {
    std::vector<std::pair<Index, Index>> ids;
    for (const auto& [first, second] : pairs) ids.push_back(std::minmax({id[first], id[second]}));
    std::sort(ids.begin(), ids.end());
    std::vector<Index> flat;
    for (const auto& [first, second] : ids) flat.insert(flat.end(), {first, second});
    h5::write_indices(group.id(), name, flat, 2, {"1", "Ids of elements that are neighbours along a fibre"});
  }
}

void write_breaks_of(hid_t place, const Domain& domain) {
  const h5::Handle group = h5::make_group(place, "breaks");
  const auto& breaks = domain.breaks().breaks;
  std::vector<std::string> families;
  for (const auto& family : domain.families()) families.push_back(family->name());
  const auto reals = [&](const char* name, auto of, const h5::Label& label) {
    std::vector<Real> numbers;
    for (const Break& b : breaks) numbers.push_back(of(b));
    h5::write_reals(group.id(), name, numbers, 1, label);
  };
  const auto indices = [&](const char* name, auto of, const h5::Label& label, const std::vector<std::string>& names) {
    std::vector<Index> numbers;
    for (const Break& b : breaks) numbers.push_back(of(b));
    const h5::Handle dataset = h5::write_indices(group.id(), name, numbers, 1, label);
    h5::set_texts_attribute(dataset.id(), "names", names);
  };
  std::vector<std::int64_t> steps;
  std::vector<Real> places;
  for (const Break& b : breaks) {
    steps.push_back(b.step);
    places.insert(places.end(), {b.place[0], b.place[1], b.place[2]});
  }
  reals("time", [](const Break& b) { return b.time; }, {"s", "Time of the break"});
  reals("energy", [](const Break& b) { return b.energy; }, {"J", "Energy released with the break"});
  indices(
      "family", [](const Break& b) { return b.family; }, {"1", "Row of family_names"}, families);
  indices("bond", [](const Break& b) { return b.bond; }, {"1", "Id of the bond"}, {});
  indices(
      "mode", [](const Break& b) { return b.mode; }, {"1", "Row of mode_names"}, domain.breaks().modes);
  indices("element", [](const Break& b) { return b.element; },
          {"1", "Id of the element that failed, -1 where it was the bond"}, {});
  h5::write_integers(group.id(), "step", steps, {"1", "Step of the break"});
  h5::write_reals(group.id(), "place", places, 3, {"m", "Middle of the bond"});
  h5::write_texts(group.id(), "family_names", families);
  h5::write_texts(group.id(), "mode_names", domain.breaks().modes);
}

void write_all_but_frames(hid_t file, const RunMeta& meta, const Domain& domain) {
  write_meta(file, meta);
  write_sets(file, domain);
  write_pairs(file, domain);
  write_breaks_of(file, domain);
}

// ---- small matters

void unite(std::vector<const Column*>& columns, const std::vector<const Column*>& more) {
  for (const Column* column : more)
    if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
}

void unite(FrameRequest& request, const FrameRequest& more) {
  request.picture |= more.picture;
  if (!more.view.empty()) request.view = more.view;
  unite(request.elements, more.elements);
  for (const FamilyRequest& family : more.bonds) {
    const auto same = [&](const FamilyRequest& f) { return f.table == family.table; };
    const auto there = std::find_if(request.bonds.begin(), request.bonds.end(), same);
    if (there == request.bonds.end())
      request.bonds.push_back(family);
    else
      unite(there->columns, family.columns);
  }
}

// A run.h5 that holds frames itself was left by an orderly end; one with links only is nothing that the frames do
// not say.
bool holds_frames(const path& record) {
  const h5::Handle file = h5::open_file(record);
  const h5::Handle frames = h5::open_group(file.id(), "frames");
  const auto names = h5::names_in(frames.id());
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return !h5::leads_elsewhere(frames.id(), name); });
}

bool is_one_file(const path& file) { return file.filename().string().starts_with(one_file); }

bool stands(const path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

// A name beside the file that is still free: run.h5.damaged, run.h5.damaged-2.
path free_name(const path& file, const std::string& ending) {
  path name = path(file) += ending;
  for (int number = 2; stands(name); ++number) name = path(file) += fmt::format("{}-{}", ending, number);
  return name;
}

}  // namespace

Recorder::Recorder(RunFolder& folder, RunMeta meta)
    : folder_(&folder),
      root_(folder.root()),
      record_(folder.record()),
      view_(folder.view()),
      frames_folder_(folder.frames()),
      meta_(std::move(meta)) {}

Recorder Recorder::fresh(RunFolder& folder, RunMeta meta, const Domain& domain) {
  Recorder recorder(folder, std::move(meta));
  recorder.write_master(domain);
  return recorder;
}

Recorder Recorder::resume(RunFolder& folder, RunMeta meta, const Domain& domain, std::int64_t step) {
  const h5::Silence silence;
  Recorder recorder(folder, std::move(meta));
  recorder.take_up(recorder.survey(step));
  recorder.write_master(domain);
  recorder.write_view();
  return recorder;
}

std::vector<std::filesystem::path> Recorder::frame_files() const {
  auto files = folder_->made_in(frames_folder_);
  std::erase_if(files, [](const path& file) { return file.extension() != ".h5"; });
  return files;
}

// Where a run.h5 that holds frames is kept while the run goes on: a former resume that was killed may have begun to.
std::filesystem::path Recorder::place_for_record() const {
  std::error_code error;
  for (const path& file : frame_files())
    if (is_one_file(file) && fs::equivalent(file, record_, error)) return file;
  // A kill while older ones were removed may have left any of them.
  int number = 0;
  const auto named = [&] { return frames_folder_ / fmt::format("{}{}.h5", one_file, number); };
  while (stands(named())) ++number;
  return named();
}

// A frame that stands both in a former run.h5 and in a file of its own is the one in its own file, which is newer.
Recorder::Found Recorder::survey(std::int64_t step) {
  Found found;
  auto files = frame_files();
  const auto single = std::stable_partition(files.begin(), files.end(), is_one_file);
  const auto name = [](const path& file) { return "frames/" + file.filename().string(); };
  std::for_each(files.begin(), single, [&](const path& file) { look_into(file, "/frames/", name(file), step, found); });
  if (stands(record_)) {
    try {
      found.keep_record = holds_frames(record_);
    } catch (const MachineFailure& failure) {
      found.damaged.push_back(record_);
      notes_.push_back(
          fmt::format("run.h5 is damaged and was kept under another name; a new one has the frames that stand in files "
                      "of their own ({})",
                      failure.what()));
    }
    const path aside = place_for_record();
    if (found.keep_record && !stands(aside)) look_into(record_, "/frames/", name(aside), step, found);
  }
  std::for_each(single, files.end(), [&](const path& file) { look_into(file, "/", name(file), step, found); });
  return found;
}

// Notes the frames in a file: one, which is all of it, or those of a former run.h5.
void Recorder::look_into(const path& file, const std::string& frames_in, const std::string& as, std::int64_t step,
                         Found& found) {
  const bool one = frames_in == "/";
  const auto note_damage = [&](const std::string& what, const std::exception& failure) {
    if (found.damaged.empty() || found.damaged.back() != file) found.damaged.push_back(file);
    notes_.push_back(
        fmt::format("{} is damaged and was left out; the file was kept under another name ({})", what, failure.what()));
  };
  const auto take = [&](const h5::Handle& in, const std::string& group_name) {
    const h5::Handle group = h5::open_group(in.id(), group_name);
    const std::int64_t at = h5::integer_attribute(group.id(), "step");
    if (at <= step)
      found.frames[at] = {as, group_name, xdmf_parts(describe_frame(group.id(), "/frames/" + name_of(at)), "run.h5")};
    else if (one)
      found.later.push_back(file);
  };
  const std::string relative = file.lexically_relative(root_).string();
  try {
    const h5::Handle in = h5::open_file(file);
    if (one) return take(in, frames_in);
    for (const std::string& name : h5::names_in(h5::open_group(in.id(), frames_in).id())) {
      try {
        if (!h5::leads_elsewhere(h5::open_group(in.id(), frames_in).id(), name)) take(in, frames_in + name);
      } catch (const std::exception& failure) {
        note_damage(fmt::format("frame {} of {}", name, relative), failure);
      }
    }
  } catch (const std::exception& failure) {
    note_damage(relative, failure);
  }
}

void Recorder::take_up(Found found) {
  for (const path& file : found.damaged) keep_damaged(file);
  if (found.keep_record) {
    const path aside = place_for_record();
    if (!stands(aside)) {
      folder_->claim(aside);
      // Without a copy, and without a moment in which run.h5 is missing; not every file system can.
      if (::link(record_.c_str(), aside.c_str()) != 0 && ::rename(record_.c_str(), aside.c_str()) != 0)
        throw file_failure("set aside", record_, errno);
    }
  }
  std::error_code error;
  for (const path& file : found.later) fs::remove(file, error);
  frames_ = std::move(found.frames);
}

void Recorder::keep_damaged(const path& file) {
  const path name = free_name(file, ".damaged");
  folder_->claim(name);
  const bool still_used = file == record_ || is_one_file(file);  // for the frames in it that are whole
  if (still_used && ::link(file.c_str(), name.c_str()) == 0) return;
  std::error_code error;
  if (still_used)
    fs::copy_file(file, name, error);
  else
    fs::rename(file, name, error);
  if (error) throw file_failure("set aside", file, error.value());
}

void Recorder::write(const FrameStamp& stamp, const FrameRequest& request, const Domain& domain) {
  const h5::Silence silence;
  require_open();
  if (latest_step_ != stamp.step) latest_ = {};
  unite(latest_, request);
  latest_step_ = stamp.step;
  h5::MemoryFile out;
  write_frame(out.id(), stamp, latest_, domain);
  const std::string name = name_of(stamp.step);
  folder_->claim(frames_folder_ / (name + ".h5"));
  write_atomically(frames_folder_ / (name + ".h5"), {out.image()});
  frames_[stamp.step] = {"frames/" + name + ".h5", "/",
                         xdmf_parts(describe_frame(out.id(), "/frames/" + name), "run.h5")};
  write_master(domain);
  write_view();
}

void Recorder::write_breaks(const Domain& domain) {
  require_open();
  write_master(domain);
}

void Recorder::require_open() const {
  if (closed_) throw std::logic_error("run.h5 is finished; nothing can be added to it");
}

void Recorder::write_master(const Domain& domain) const {
  const h5::Silence silence;
  h5::MemoryFile out;
  write_all_but_frames(out.id(), meta_, domain);
  const h5::Handle frames = h5::make_group(out.id(), "frames");
  for (const auto& [step, source] : frames_)
    h5::check(H5Lcreate_external(source.file.c_str(), source.group.c_str(), frames.id(), name_of(step).c_str(),
                                 H5P_DEFAULT, H5P_DEFAULT),
              "link a frame");
  write_atomically(record_, {out.image()});
}

// Without a frame there is nothing to see, and ParaView does not take a collection of nothing.
void Recorder::write_view() const {
  if (frames_.empty()) {
    std::error_code error;
    fs::remove(view_, error);
    return;
  }
  std::vector<const XdmfPart*> parts;
  for (const auto& [step, source] : frames_)
    for (const XdmfPart& part : source.view) parts.push_back(&part);
  write_atomically(view_, xdmf_document(parts));
}

// Returns the length of what was written; the file itself may be longer by what was reserved and not needed.
std::uintmax_t Recorder::write_one_file(const path& part, const Domain& domain) const {
  const h5::Handle access = h5::take(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a file");
  H5Pset_file_locking(access.id(), false, true);
  make_part(record_);
  const h5::Handle out = h5::make_file(part.string(), access.id());
  reserve(part, room_for_one_file());  // HDF5 does not survive a disk that fills up while it copies an object
  write_all_but_frames(out.id(), meta_, domain);
  const h5::Handle frames = h5::make_group(out.id(), "frames");
  for (const auto& [step, source] : frames_) {
    const h5::Handle in = h5::open_file(root_ / source.file);
    h5::check(H5Ocopy(in.id(), source.group.c_str(), frames.id(), name_of(step).c_str(), H5P_DEFAULT, H5P_DEFAULT),
              "copy frame " + name_of(step));
  }
  h5::check(H5Fflush(out.id(), H5F_SCOPE_GLOBAL), "finish '" + part.string() + "'");
  hsize_t size = 0;
  h5::check(H5Fget_filesize(out.id(), &size), "finish '" + part.string() + "'");
  return size;
}

std::uintmax_t Recorder::room_for_one_file() const {
  std::uintmax_t size = fs::file_size(record_) + (1 << 20);
  for (const path& file : frame_files()) size += fs::file_size(file);
  return size + 4096 * frames_.size();
}

bool Recorder::consolidate(const Domain& domain, std::string& reason) {
  const h5::Silence silence;
  require_open();
  const path part = part_of(record_);
  try {
    write_master(domain);
    fs::resize_file(part, write_one_file(part, domain));
    put_in_place(part, record_);
  } catch (const std::exception& failure) {
    std::error_code error;
    fs::remove(part, error);
    reason = failure.what();
    return false;
  }
  // From here on run.h5 is whole by itself; files that cannot be removed only take space.
  std::error_code error;
  for (const path& file : frame_files()) fs::remove(file, error);
  fs::remove(frames_folder_, error);
  closed_ = true;
  return true;
}

}  // namespace beadwork
