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
  indices("family", [](const Break& b) { return b.family; }, {"1", "Row of family_names"}, families);
  indices("bond", [](const Break& b) { return b.bond; }, {"1", "Id of the bond"}, {});
  indices("mode", [](const Break& b) { return b.mode; }, {"1", "Row of mode_names"}, domain.breaks().modes);
  h5::write_integers(group.id(), "step", steps, {"1", "Step of the break"});
  h5::write_reals(group.id(), "place", places, 3, {"m", "Middle of the bond"});
  h5::write_texts(group.id(), "family_names", families);
  h5::write_texts(group.id(), "mode_names", domain.breaks().modes);
}

void write_all_but_frames(hid_t file, const RunMeta& meta, const Domain& domain) {
  write_meta(file, meta);
  write_sets(file, domain);
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
  std::error_code error;
  if (!fs::exists(record, error)) return false;
  const h5::Handle file = h5::open_file(record);
  if (!h5::has(file.id(), "frames")) return false;
  const h5::Handle frames = h5::open_group(file.id(), "frames");
  for (const std::string& name : h5::names_in(frames.id())) {
    H5L_info_t info;
    h5::check(H5Lget_info(frames.id(), name.c_str(), &info, H5P_DEFAULT), "look at frame '" + name + "'");
    if (info.type == H5L_TYPE_HARD) return true;
  }
  return false;
}

std::vector<path> files_in(const path& folder) {
  std::vector<path> files;
  std::error_code error;
  for (auto it = fs::directory_iterator(folder, error); !error && it != fs::directory_iterator(); it.increment(error))
    if (it->path().extension() == ".h5") files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

bool is_one_file(const path& file) { return file.filename().string().starts_with(one_file); }

// Keeps the frames of a former end under frames/, without copying them and without a moment in which run.h5 is missing.
void set_aside(const path& record, const path& frames_folder) {
  std::error_code error;
  fs::create_directories(frames_folder, error);
  int number = 0;
  for (const path& file : files_in(frames_folder)) {
    if (fs::equivalent(file, record, error)) return;  // a resume that was killed here had already done it
    if (is_one_file(file)) ++number;
  }
  const path aside = frames_folder / fmt::format("{}{}.h5", one_file, number);
  if (::link(record.c_str(), aside.c_str()) == 0) return;
  if (::rename(record.c_str(), aside.c_str()) != 0) throw file_failure("set aside", record, errno);
}

}  // namespace

Recorder::Recorder(const RunFolder& folder, RunMeta meta, Options options)
    : root_(folder.root()), record_(folder.record()), view_(folder.view()), frames_folder_(folder.frames()),
      meta_(std::move(meta)), options_(options) {}

Recorder Recorder::fresh(const RunFolder& folder, RunMeta meta, Options options, const Domain& domain) {
  Recorder recorder(folder, std::move(meta), options);
  recorder.write_master(domain);
  return recorder;
}

Recorder Recorder::resume(const RunFolder& folder, RunMeta meta, Options options, const Domain& domain,
                          std::int64_t step) {
  const h5::Silence silence;
  Recorder recorder(folder, std::move(meta), options);
  if (holds_frames(recorder.record_)) set_aside(recorder.record_, recorder.frames_folder_);
  recorder.take_up(step);
  recorder.write_master(domain);
  recorder.write_view();
  return recorder;
}

// A frame that stands both in a former run.h5 and in a file of its own is the one in its own file, which is newer.
void Recorder::take_up(std::int64_t step) {
  auto files = files_in(frames_folder_);
  std::stable_partition(files.begin(), files.end(), is_one_file);
  for (const path& file : files) take_up_file(file.filename().string(), step);
}

void Recorder::take_up_file(const std::string& file, std::int64_t step) {
  const path full = frames_folder_ / file;
  bool later = false;
  try {
    const h5::Handle in = h5::open_file(full);
    const auto take = [&](const std::string& group_name) {
      const h5::Handle group = h5::open_group(in.id(), group_name);
      const std::int64_t at = h5::integer_attribute(group.id(), "step");
      if (at > step)
        later = true;
      else
        frames_[at] = {"frames/" + file, group_name, xdmf_parts(describe_frame(group.id(), "/frames/" + name_of(at)), "run.h5")};
    };
    if (is_one_file(full))
      for (const std::string& name : h5::names_in(h5::open_group(in.id(), "frames").id())) take("/frames/" + name);
    else
      take("/");
    if (later && !is_one_file(full)) fs::remove(full);
  } catch (const MachineFailure& failure) {
    throw MachineFailure(fmt::format("{}. Remove '{}' to go on without it", failure.what(), full.string()));
  }
}

void Recorder::write(const FrameStamp& stamp, const FrameRequest& request, const Domain& domain) {
  const h5::Silence silence;
  require_open();
  if (latest_step_ != stamp.step) latest_ = {};
  unite(latest_, request);
  latest_step_ = stamp.step;
  h5::MemoryFile out;
  write_frame(out.id(), stamp, latest_, domain, {options_.single, options_.gzip});
  const std::string name = name_of(stamp.step);
  std::error_code error;
  fs::create_directories(frames_folder_, error);
  if (error) throw file_failure("make folder", frames_folder_, error.value());
  write_atomically(frames_folder_ / (name + ".h5"), {out.image()});
  frames_[stamp.step] = {"frames/" + name + ".h5", "/", xdmf_parts(describe_frame(out.id(), "/frames/" + name), "run.h5")};
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
    h5::check(H5Lcreate_external(source.file.c_str(), source.group.c_str(), frames.id(), name_of(step).c_str(), H5P_DEFAULT,
                                 H5P_DEFAULT),
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
  const h5::Handle out = h5::take(H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "make a file");
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
  for (const path& file : files_in(frames_folder_)) size += fs::file_size(file);
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
  for (const path& file : files_in(frames_folder_)) fs::remove(file, error);
  fs::remove(frames_folder_, error);
  closed_ = true;
  return true;
}

}  // namespace beadwork
