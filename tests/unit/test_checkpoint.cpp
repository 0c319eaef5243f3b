// Checkpoints: everything that is kept comes back to the bit, what does not fit is refused, and no kill, no full disk
// and no damaged byte passes for a checkpoint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "core/io/checkpoint.hpp"
#include "core/io/file.hpp"
#include "tests/support/bonded_bar.hpp"
#include "tests/support/scratch.hpp"

using namespace beadwork;
using namespace beadwork::testing;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

CheckpointMeta some_meta(std::int64_t step = 4200) {
  return {"0.1.0",
          "5e884898da28",
          "<scene name=\"bar\"/>",
          {0.1 + 0.2, step, 0.1, 1, 0.3, step / 2},
          18446744073709551615u,
          {{"seed state", "a b c"}}};
}

struct Bar {
  Domain domain;
  explicit Bar(Index count = 0) {
    declare_bar(domain);
    if (count > 0) fill_bar(domain, count);
  }
};

/// The bytes of a column, row by row.
std::string bytes_of(const Column& column, Index rows) {
  std::string out;
  const Type type = column.field().type;
  for (Index row = 0; row < rows; ++row)
    for (int c = 0; c < components(type); ++c) {
      const auto offset =
          static_cast<std::size_t>(row) * column.stride() + static_cast<std::size_t>(c) * column.plane();
      out.append(reinterpret_cast<const char*>(column.base() + offset), component_bytes(type));
    }
  return out;
}

void expect_same_kept_columns(const Table& a, const Table& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const Column* column : a.columns()) {
    if (!column->kept()) continue;
    const Column* other = b.find(column->field().name);
    ASSERT_NE(other, nullptr) << column->field().name;
    EXPECT_TRUE(bytes_of(*column, a.size()) == bytes_of(*other, b.size())) << column->field().name;
    EXPECT_EQ(column->field().unit, other->field().unit);
    EXPECT_EQ(column->field().doc, other->field().doc);
    EXPECT_TRUE(other->kept());
  }
}

std::string break_text(const BreakLog& log) {
  std::string out;
  for (const Break& b : log.breaks) {
    const Real reals[] = {b.time, b.place[0], b.place[1], b.place[2], b.energy};
    out.append(reinterpret_cast<const char*>(reals), sizeof reals);
    out += " " + std::to_string(b.step) + " " + std::to_string(b.family) + " " + std::to_string(b.bond) + " " +
           log.modes.at(static_cast<std::size_t>(b.mode)) + "\n";
  }
  return out;
}

void expect_same_domain(const Domain& a, const Domain& b) {
  expect_same_kept_columns(a.elements(), b.elements());
  expect_same_kept_columns(a.scene(), b.scene());
  ASSERT_EQ(a.families().size(), b.families().size());
  for (std::size_t f = 0; f < a.families().size(); ++f) {
    EXPECT_EQ(a.families()[f]->name(), b.families()[f]->name());
    expect_same_kept_columns(a.families()[f]->rows(), b.families()[f]->rows());
  }
  EXPECT_EQ(a.sets(), b.sets());
  EXPECT_TRUE(break_text(a.breaks()) == break_text(b.breaks()));
}

}  // namespace

TEST(Checkpoint, everything_kept_comes_back_to_the_bit) {
  const Scratch scratch;
  Bar bar(2000);
  break_some(bar.domain, 0, 11, 100);
  break_some(bar.domain, 1, 5, 200);
  save_checkpoint(scratch / "checkpoint.h5", bar.domain, some_meta());
  Bar back;
  load_checkpoint(scratch / "checkpoint.h5", back.domain);
  EXPECT_EQ(back.domain.size(), 2000);
  expect_same_domain(bar.domain, back.domain);
}

TEST(Checkpoint, listed_neighbours_come_back) {
  const Scratch scratch;
  Bar bar(6);
  bar.domain.pairs()["fibre"] = {{0, 1}, {1, 4}};
  save_checkpoint(scratch / "checkpoint.h5", bar.domain, some_meta());
  Bar back;
  back.domain.pairs()["other"] = {{0, 1}};
  load_checkpoint(scratch / "checkpoint.h5", back.domain);
  EXPECT_EQ(back.domain.pairs(), bar.domain.pairs());
}

TEST(Checkpoint, what_the_scene_lists_comes_back_and_must_be_as_long) {
  const Scratch scratch;
  const auto list_work = [](Domain& domain, Index rows) {
    domain.list("constraints").resize(rows);
    return domain.list("constraints").add({"work", On::scene, Type::real, "J", "Work", ""}).keep(),
           domain.list("constraints").column("work").view<Real>();
  };
  Bar bar(3), back, longer;
  const auto work = list_work(bar.domain, 2);
  work[0] = 1.5, work[1] = -0.1;
  save_checkpoint(scratch / "c.h5", bar.domain, some_meta());
  const auto got = list_work(back.domain, 2);
  load_checkpoint(scratch / "c.h5", back.domain);
  EXPECT_EQ(got[0], 1.5);
  EXPECT_EQ(got[1], -0.1);
  EXPECT_EQ(back.domain.lists().size(), 1u);

  Bar without;  // a mover will ask for it
  load_checkpoint(scratch / "c.h5", without.domain);
  EXPECT_EQ(list_work(without.domain, 2)[1], -0.1);

  list_work(longer.domain, 3);
  EXPECT_NE(beadwork::testing::message_of<DeckFailure>([&] {
              load_checkpoint(scratch / "c.h5", longer.domain);
            }).find("does not list the 3 constraints"),
            std::string::npos);
}

TEST(Checkpoint, numbers_that_are_no_numbers_keep_their_bits_too) {
  const Scratch scratch;
  Bar bar(4);
  const auto radius = bar.domain.elements().column("radius").view<Real>();
  radius[0] = std::numeric_limits<Real>::quiet_NaN();
  radius[1] = -0.0;
  radius[2] = std::numeric_limits<Real>::denorm_min();
  radius[3] = -std::numeric_limits<Real>::infinity();
  save_checkpoint(scratch / "c.h5", bar.domain, some_meta());
  Bar back;
  load_checkpoint(scratch / "c.h5", back.domain);
  const auto got = back.domain.elements().column("radius").view<Real>();
  for (Index i = 0; i < 4; ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(got[i]), std::bit_cast<std::uint64_t>(radius[i]));
}

TEST(Checkpoint, a_kept_column_of_any_type_comes_back) {
  const Scratch scratch;
  const auto declare = [](Domain& domain) {
    for (const Type type : {Type::real, Type::vec3, Type::quat, Type::index, Type::state, Type::sym3})
      domain.elements().add({type_name(type), On::elements, type, "1", "", ""}).keep();
  };
  Domain domain, back;
  declare(domain);
  domain.add_elements(3);
  domain.elements().column(type_name(Type::sym3)).view<Sym3>().set(1, {1, 2, 3, 4, 5, 6});
  domain.elements().column(type_name(Type::vec3)).view<Vec3>().set(2, Vec3(7, 8, 9));
  domain.elements().column(type_name(Type::state)).view<State>()[1] = State::broken;
  domain.elements().column(type_name(Type::index)).view<Index>()[0] = -3;
  save_checkpoint(scratch / "c.h5", domain, some_meta());
  declare(back);
  load_checkpoint(scratch / "c.h5", back);
  expect_same_kept_columns(domain.elements(), back.elements());
}

TEST(Checkpoint, what_is_known_of_the_run_comes_back) {
  const Scratch scratch;
  CheckpointMeta meta = some_meta();
  meta.resolved = std::string(300000, 'x') + "\n<!-- \xC3\xA9 -->\n";  // longer than an attribute of HDF5 may be
  meta.texts["empty"] = "";
  meta.texts["two lines"] = "a\nb";
  save_checkpoint(scratch / "c.h5", Bar(3).domain, meta);
  const CheckpointMeta got = read_checkpoint_meta(scratch / "c.h5");
  EXPECT_EQ(got.version, meta.version);
  EXPECT_EQ(got.deck_sha256, meta.deck_sha256);
  EXPECT_TRUE(got.resolved == meta.resolved);
  const auto bits = [](Real number) { return std::bit_cast<std::uint64_t>(number); };
  EXPECT_EQ(got.moment.stage, meta.moment.stage);
  EXPECT_EQ(bits(got.moment.time), bits(meta.moment.time));
  EXPECT_EQ(got.moment.step, meta.moment.step);
  EXPECT_EQ(bits(got.moment.time_step), bits(meta.moment.time_step));
  EXPECT_EQ(bits(got.moment.stage_start), bits(meta.moment.stage_start));
  EXPECT_EQ(got.moment.stage_step, meta.moment.stage_step);
  EXPECT_EQ(got.seed, meta.seed);
  EXPECT_EQ(got.texts, meta.texts);
}

TEST(Checkpoint, what_is_not_kept_takes_no_room_and_comes_back_as_in_a_new_domain) {
  const Scratch scratch;
  Bar bar(10);
  bar.domain.elements().column("force").view<Vec3>().set(3, Vec3(1, 2, 3));
  save_checkpoint(scratch / "c.h5", bar.domain, some_meta());
  EXPECT_THAT(text_of(scratch / "c.h5"), ::testing::Not(HasSubstr("axial-force")));
  Bar back;
  load_checkpoint(scratch / "c.h5", back.domain);
  EXPECT_EQ(back.domain.elements().column("force").view<Vec3>()[3], zero<Vec3>());
}

TEST(Checkpoint, orientation_that_is_not_kept_comes_back_unturned) {
  const Scratch scratch;
  Domain domain;
  domain.add_elements(2);
  save_checkpoint(scratch / "c.h5", domain, some_meta());
  Domain back;
  back.elements().add(field::orientation);
  load_checkpoint(scratch / "c.h5", back);
  EXPECT_EQ(back.elements().column("orientation").view<Quat>()[1].w, 1);
}

TEST(Checkpoint, bonds_are_cut_as_before_whether_or_not_the_broken_ones_were_swept) {
  for (const bool swept : {false, true}) {
    const Scratch scratch;
    Bar bar(3000);
    BondTable& bonds = *bar.domain.families()[0];
    break_some(bar.domain, 0, 13, 100);
    bonds.sweep();
    break_some(bar.domain, 0, 17, 200);
    if (swept) bonds.sweep();
    save_checkpoint(scratch / "c.h5", bar.domain, some_meta());
    Bar back;
    load_checkpoint(scratch / "c.h5", back.domain);
    back.domain.cut_families();
    BondTable& again = *back.domain.families()[0];
    if (!swept) {
      bonds.sweep();  // the next thing that happens in either
      again.sweep();
    }
    EXPECT_EQ(bonds.live(), again.live());
    ASSERT_EQ(bonds.size(), again.size());
    for (Index b = 0; b < bonds.size(); ++b) {
      ASSERT_EQ(bonds.id()[b], again.id()[b]) << "row " << b;
      ASSERT_EQ(bonds.target()[b], again.target()[b]) << "row " << b;
      ASSERT_EQ(bonds.state()[b], again.state()[b]) << "row " << b;
    }
    EXPECT_EQ(bonds.halo(), again.halo());
    for (std::size_t c = 0; c < bonds.chunks().size(); ++c)
      EXPECT_EQ(bonds.chunks()[c].live_end, again.chunks()[c].live_end) << "chunk " << c;
  }
}

TEST(Checkpoint, a_domain_of_nothing_comes_back) {
  const Scratch scratch;
  save_checkpoint(scratch / "c.h5", Domain(), {});
  Domain back;
  load_checkpoint(scratch / "c.h5", back);
  EXPECT_EQ(back.size(), 0);
  EXPECT_TRUE(back.families().empty());
}

TEST(Checkpoint, a_domain_that_was_filled_already_is_filled_anew) {
  const Scratch scratch;
  Bar bar(50);
  save_checkpoint(scratch / "c.h5", bar.domain, some_meta());
  Bar other(80);
  load_checkpoint(scratch / "c.h5", other.domain);
  expect_same_domain(bar.domain, other.domain);
}

TEST(Checkpoint, a_family_of_a_later_stage_stays_empty) {
  const Scratch scratch;
  Bar bar(200);
  break_some(bar.domain, 1, 5, 3);
  save_checkpoint(scratch / "c.h5", bar.domain, some_meta());
  Domain back;
  back.add_family("of stage two");
  declare_bar(back);
  load_checkpoint(scratch / "c.h5", back);
  EXPECT_EQ(back.find_family("of stage two")->size(), 0);
  EXPECT_EQ(back.find_family("resin")->size(), 199);
  ASSERT_FALSE(back.breaks().breaks.empty());
  EXPECT_EQ(back.families()[static_cast<std::size_t>(back.breaks().breaks[0].family)]->name(), "interface");
}

TEST(Checkpoint, a_column_that_a_plugin_adds_only_later_is_not_lost) {
  const Scratch scratch;
  Bar bar(20);
  save_checkpoint(scratch / "c.h5", bar.domain, some_meta());
  Domain back;
  back.add_family("resin");
  back.add_family("interface");
  load_checkpoint(scratch / "c.h5", back);
  expect_same_domain(bar.domain, back);
}

TEST(Checkpoint, a_kept_column_that_the_file_has_not_is_refused_by_name) {
  const Scratch scratch;
  save_checkpoint(scratch / "c.h5", Bar(20).domain, some_meta());
  Bar back;
  back.domain.find_family("resin")->rows().add({"wear", On::bonds, Type::real, "1", "", ""}).keep();
  const auto said = message_of<DeckFailure>([&] { load_checkpoint(scratch / "c.h5", back.domain); });
  EXPECT_THAT(said, HasSubstr("'wear'"));
  EXPECT_THAT(said, HasSubstr("'resin'"));
}

TEST(Checkpoint, a_column_of_another_unit_or_type_is_refused_with_both) {
  const Scratch scratch;
  Domain domain;
  domain.elements().add({"heat", On::elements, Type::real, "J", "", ""}).keep();
  domain.add_elements(1);
  save_checkpoint(scratch / "c.h5", domain, some_meta());
  for (const Field& other :
       {Field{"heat", On::elements, Type::real, "K", "", ""}, Field{"heat", On::elements, Type::vec3, "J", "", ""}}) {
    Domain back;
    back.elements().add(other).keep();
    const auto said = message_of<DeckFailure>([&] { load_checkpoint(scratch / "c.h5", back); });
    EXPECT_THAT(said, HasSubstr("'heat'"));
    EXPECT_THAT(said, HasSubstr("real [J]"));
  }
}

TEST(Checkpoint, bonds_that_the_scene_has_not_are_refused_by_name) {
  const Scratch scratch;
  save_checkpoint(scratch / "c.h5", Bar(20).domain, some_meta());
  Domain back;
  back.add_family("resin");
  EXPECT_THAT(message_of<DeckFailure>([&] { load_checkpoint(scratch / "c.h5", back); }), HasSubstr("'interface'"));
}

TEST(Checkpoint, every_damaged_byte_is_recognised) {
  const Scratch scratch;
  save_checkpoint(scratch / "c.h5", Bar(30).domain, some_meta());
  const std::string whole = text_of(scratch / "c.h5");
  for (std::size_t at = 0; at < whole.size(); at += 131) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    write_text(scratch / "d.h5", damaged);
    Bar back;
    const auto said = message_of<MachineFailure>([&] { load_checkpoint(scratch / "d.h5", back.domain); });
    ASSERT_THAT(said, HasSubstr("d.h5")) << "byte " << at;
    ASSERT_THAT(said, HasSubstr("damaged")) << "byte " << at;
  }
}

TEST(Checkpoint, a_file_that_was_cut_short_is_recognised) {
  const Scratch scratch;
  save_checkpoint(scratch / "c.h5", Bar(30).domain, some_meta());
  const std::string whole = text_of(scratch / "c.h5");
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, whole.size() / 2, whole.size() - 1}) {
    write_text(scratch / "d.h5", whole.substr(0, size));
    EXPECT_THAT(message_of<MachineFailure>([&] { read_checkpoint_meta(scratch / "d.h5"); }), HasSubstr("damaged"));
  }
}

TEST(Checkpoint, a_missing_file_is_named_with_the_reason) {
  EXPECT_THAT(message_of<MachineFailure>([] { read_checkpoint_meta("/nowhere/c.h5"); }),
              ::testing::AllOf(HasSubstr("/nowhere/c.h5"), HasSubstr("No such file")));
}

TEST(Checkpoint, a_kill_at_any_moment_leaves_a_whole_checkpoint) {
  const Scratch scratch;
  const fs::path file = scratch / "checkpoint.h5";
  Bar bar(5000);
  const auto step_column = bar.domain.scene().column("work").view<Real>();
  step_column[0] = 0;
  save_checkpoint(file, bar.domain, some_meta(0));
  std::int64_t newest = 0;
  // On a slow machine the first kills come before anything is written: go on until some have come in the midst of it.
  for (unsigned trial = 0; trial < 30 || newest < 6; ++trial) {
    kill_during(
        [&] {
          for (std::int64_t step = newest + 1;; ++step) {
            step_column[0] = static_cast<Real>(step);
            save_checkpoint(file, bar.domain, some_meta(step));
          }
        },
        3000 + 1900 * trial);
    Bar back;
    ASSERT_NO_THROW(load_checkpoint(file, back.domain)) << "trial " << trial;
    newest = read_checkpoint_meta(file).moment.step;
    EXPECT_EQ(back.domain.scene().column("work").view<Real>()[0], static_cast<Real>(newest)) << "trial " << trial;
    EXPECT_EQ(back.domain.size(), 5000);
  }
}

TEST(Checkpoint, a_full_disk_leaves_the_former_checkpoint_and_is_named) {
  const SmallDisk disk(8 << 20);
  if (!disk.there()) GTEST_SKIP() << "only root may mount a small disk";
  const fs::path file = disk.path() / "checkpoint.h5";
  Bar small(100), large(20000);
  save_checkpoint(file, small.domain, some_meta(1));
  disk.fill_but(1 << 20);
  const auto said = message_of<MachineFailure>([&] { save_checkpoint(file, large.domain, some_meta(2)); });
  EXPECT_THAT(said, HasSubstr("No space left on device"));
  EXPECT_THAT(said, HasSubstr("checkpoint.h5"));
  EXPECT_EQ(read_checkpoint_meta(file).moment.step, 1);
  EXPECT_FALSE(fs::exists(part_of(file)));
}
