// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"

namespace antiradiance {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

void sleep_ms(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

TEST(parallel_for, visits_each_index_once) {
    for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
        Progress progress;
        std::vector<std::atomic<int>> visits(count);
        parallel_for(count, progress, [&](std::size_t i) { ++visits.at(i); });
        for (const auto& v : visits)
            EXPECT_EQ(v.load(), 1);
    }
}

TEST(parallel_for, results_of_the_bodies_are_visible_afterwards) {
    // Plain writes: under the thread sanitizer this shows that the loop's end is ordered.
    Progress progress;
    std::vector<int> squares(1000);
    parallel_for(squares.size(), progress,
                 [&](std::size_t i) { squares[i] = static_cast<int>(i * i); });
    for (std::size_t i = 0; i < squares.size(); ++i) {
        EXPECT_EQ(squares[i], static_cast<int>(i * i));
    }
}

TEST(parallel_for_blocks, blocks_tile_the_range) {
    for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 1000U}) {
        Progress progress;
        std::vector<std::atomic<int>> visits(count);
        parallel_for_blocks(count, 8, progress, [&](std::size_t begin, std::size_t end) {
            EXPECT_LT(begin, end);
            EXPECT_LE(end - begin, 8U);
            for (std::size_t i = begin; i < end; ++i)
                ++visits.at(i);
        });
        for (const auto& v : visits)
            EXPECT_EQ(v.load(), 1);
    }
}

TEST(parallel_for, begins_no_body_while_paused_and_leaves_none_out) {
    PauseGate gate;
    Progress progress({}, {}, &gate);
    std::vector<std::atomic<int>> visits(200);
    std::atomic<int> done{0};
    std::jthread loop([&] {
        parallel_for(visits.size(), progress, [&](std::size_t i) {
            sleep_ms(1);
            ++visits[i];
            ++done;
        });
    });
    while (done < 10)
        sleep_ms(1);
    gate.hold();
    gate.hold();
    sleep_ms(30);  // bodies under way end
    const int paused_at = done;
    EXPECT_LT(paused_at, 200);
    gate.release();  // one is left
    sleep_ms(50);
    EXPECT_EQ(done, paused_at);
    gate.release();
    loop.join();
    for (const auto& v : visits)
        EXPECT_EQ(v.load(), 1);
}

TEST(parallel_for, can_be_cancelled_while_paused) {
    PauseGate gate;
    Progress progress({}, {}, &gate);
    gate.hold();
    std::jthread canceller([&] {
        sleep_ms(50);
        progress.cancel();
    });
    std::atomic<int> begun{0};
    EXPECT_THROW(parallel_for(100, progress, [&](std::size_t) { ++begun; }), Cancelled);
    EXPECT_EQ(begun, 0);
}

TEST(parallel_for, callbacks_come_from_the_calling_thread_and_rise) {
    const auto caller = std::this_thread::get_id();
    std::vector<float> fractions;
    Progress progress(
        [&](float fraction, const std::string& stage) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_EQ(stage, "links");
            fractions.push_back(fraction);
        },
        [&] {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            return false;
        });
    progress.begin_stage("links", 0.2F, 0.4F);
    parallel_for(300, progress, [](std::size_t) { sleep_ms(5); }, {0.5F, 1.0F});
    ASSERT_GE(fractions.size(), 2U);           // 300 x 5 ms last 20 ms even on 75 cores
    EXPECT_FLOAT_EQ(fractions.front(), 0.2F);  // begin_stage
    for (std::size_t i = 1; i < fractions.size(); ++i) {
        EXPECT_GE(fractions[i], 0.3F - 1e-6F);  // the span's begin within the stage
        EXPECT_LE(fractions[i], 0.4F + 1e-6F);
        EXPECT_GE(fractions[i], fractions[i - 1]);
    }
}

TEST(parallel_for, forwards_the_error_of_a_body) {
    for (const std::size_t count : {1U, 100U}) {
        Progress progress;
        EXPECT_THROW(parallel_for(count, progress,
                                  [](std::size_t i) {
                                      if (i == 0) throw SceneError("Cube is broken");
                                  }),
                     SceneError);
    }
}

TEST(parallel_for, forwards_the_error_of_a_callback_not_the_cancellation_it_causes) {
    Progress progress([](float, const std::string&) { throw std::domain_error("from Python"); },
                      nullptr);
    EXPECT_THROW(parallel_for(1000, progress, [](std::size_t) { sleep_ms(2); }), std::domain_error);
}

TEST(parallel_for, stops_within_a_tenth_of_a_second_of_the_callers_wish) {
    Clock::time_point wish;
    std::atomic<int> bodies{0};
    Progress progress(nullptr, [&] {
        if (bodies.load() < 10) return false;
        wish = Clock::now();
        return true;
    });
    EXPECT_THROW(parallel_for(100000, progress,
                              [&](std::size_t) {
                                  ++bodies;
                                  sleep_ms(5);
                              }),
                 Cancelled);
    // One body of 5 ms and one poll of 20 ms; the rest is for a busy machine.
    EXPECT_LT(seconds_since(wish), 0.1);
    EXPECT_LT(bodies.load(), 100000);
}

TEST(parallel_for, does_not_start_once_cancelled) {
    Progress progress;
    progress.cancel();
    std::atomic<int> bodies{0};
    EXPECT_THROW(parallel_for(10, progress, [&](std::size_t) { ++bodies; }), Cancelled);
    EXPECT_EQ(bodies.load(), 0);
}

}  // namespace
}  // namespace antiradiance
