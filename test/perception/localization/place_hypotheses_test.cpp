#include "perception/localization/place_hypotheses.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

constexpr PlaceHypotheses::Options kOptions{0.75, 0.5, 0.1};
constexpr double kNow_s = 10.0;

PlaceHypothesis place(double x, double quality, double proved_s = 5.0) {
  PlaceHypothesis result;
  result.base.pose.position = {x, 0.0};
  result.quality = quality;
  result.proved_s = proved_s;
  return result;
}

/// What has been believed at the origin, and explains so much now.
PlaceHypotheses known(double quality) {
  PlaceHypotheses places(kOptions);
  PlaceHypothesis here = place(0.0, 0.9);
  here.confirmed = true;
  places.add(here);
  EXPECT_TRUE(places.believe(kNow_s));
  places.all()[0].quality = quality;
  return places;
}

TEST(PlaceHypothesesTest, APlaceIsBelievedThatIsTriedConfirmedAndAlone) {
  const auto believes = [](const PlaceHypothesis& one, double rival) {
    PlaceHypotheses places(kOptions);
    places.add(one);
    if (rival > 0.0) places.add(place(7.0, rival));
    places.sift(kNow_s);
    return places.believe(kNow_s) && places.is_certain();
  };
  PlaceHypothesis one = place(0.0, 0.8);
  EXPECT_FALSE(believes(one, 0.0)) << "found once";
  one.confirmed = true;
  EXPECT_TRUE(believes(one, 0.0));
  EXPECT_TRUE(believes(one, 0.69));
  EXPECT_FALSE(believes(one, 0.71));
  one.proved_s = kNow_s + 0.1;
  EXPECT_FALSE(believes(one, 0.0)) << "not tried";
  one.proved_s = kNow_s;
  one.quality = 0.74;
  EXPECT_FALSE(believes(one, 0.0)) << "explains too little";
}

TEST(PlaceHypothesesTest, FoundAgainByAnotherSearchIsConfirmed) {
  const auto is_confirmed = [](const PlaceHypothesis& again) {
    PlaceHypotheses places(kOptions);
    places.add(place(0.0, 0.9, 5.0));
    places.add(again);
    places.sift(kNow_s);
    EXPECT_EQ(places.all().size(), 1u);
    EXPECT_EQ(places.all()[0].proved_s, 5.0);
    return places.all()[0].confirmed;
  };
  EXPECT_TRUE(is_confirmed(place(0.1, 0.95, 7.0)));
  EXPECT_TRUE(is_confirmed(place(0.1, 0.76, 7.0)));
  EXPECT_FALSE(is_confirmed(place(0.1, 0.7, 7.0))) << "hardly";
  EXPECT_FALSE(is_confirmed(place(0.1, 0.95, 5.0))) << "by the same search";
}

/// Another place, which the robot must have been carried to.
PlaceHypothesis far_away(double quality, double proved_s = 5.0) {
  PlaceHypothesis far = place(7.0, quality, proved_s);
  far.carried = true;
  return far;
}

TEST(PlaceHypothesesTest, WhatWasBelievedIsKeptAsLongAsNothingIsBetterByFar) {
  PlaceHypotheses places = known(0.55);
  places.add(far_away(0.94));
  places.sift(kNow_s);
  EXPECT_EQ(places.all().size(), 2u);
  EXPECT_TRUE(places.is_certain());
  places.all()[0].quality = 0.53;
  places.sift(kNow_s);
  ASSERT_EQ(places.all().size(), 1u);
  EXPECT_EQ(places.all()[0].base.pose.position.x(), 7.0);
}

TEST(PlaceHypothesesTest, NothingIsCertainWhileAPlaceThatWasFoundTwiceIsBetter) {
  PlaceHypotheses places = known(0.7);
  PlaceHypothesis far = far_away(0.85);
  far.confirmed = true;
  places.add(far);
  places.sift(kNow_s);
  EXPECT_EQ(places.all().size(), 2u);
  EXPECT_FALSE(places.is_certain());
  places.all()[0].quality = 0.76;
  EXPECT_TRUE(places.is_certain());
}

TEST(PlaceHypothesesTest, APlaceThatExplainedNextToNothingHasToBeAloneToBeBelievedAgain) {
  PlaceHypotheses places = known(0.25);
  places.add(far_away(0.54, kNow_s + 1.0));
  places.sift(kNow_s);
  ASSERT_EQ(places.all().size(), 2u);
  EXPECT_TRUE(places.is_doubted());
  EXPECT_FALSE(places.is_certain());
  for (PlaceHypothesis& place : places.all()) place.quality = place.known ? 0.9 : 0.85;
  places.sift(kNow_s);
  EXPECT_TRUE(places.all()[0].known);
  EXPECT_FALSE(places.believe(kNow_s)) << "the robot may have been carried";
  places.all()[1].quality = 0.75;
  places.sift(kNow_s);
  EXPECT_TRUE(places.believe(kNow_s));
  EXPECT_FALSE(places.is_doubted());
}

TEST(PlaceHypothesesTest, APlaceThatExplainsNextToNothingYieldsToOneThatExplainsMore) {
  PlaceHypotheses places = known(0.25);
  places.add(far_away(0.6, kNow_s + 1.0));
  EXPECT_FALSE(places.sift(kNow_s)) << "not tried";
  EXPECT_EQ(places.all().size(), 2u);
  EXPECT_TRUE(places.sift(kNow_s + 1.0));
  ASSERT_EQ(places.all().size(), 1u);
  EXPECT_EQ(places.all()[0].base.pose.position.x(), 7.0);
  EXPECT_FALSE(places.all()[0].carried);
}

TEST(PlaceHypothesesTest, ASlipIsNoticedAtOnceAndBelievedAfterATrial) {
  PlaceHypotheses places = known(0.6);
  PlaceHypothesis slipped = place(0.6, 0.95, kNow_s + 1.0);
  places.add(slipped);
  places.sift(kNow_s);
  EXPECT_FALSE(places.is_certain());
  EXPECT_EQ(places.all().size(), 2u);
  places.sift(kNow_s + 1.0);
  ASSERT_EQ(places.all().size(), 1u);
  EXPECT_EQ(places.all()[0].base.pose.position.x(), 0.6);
}

TEST(PlaceHypothesesTest, NothingIsCertainWhereNothingIsKnown) {
  PlaceHypotheses places(kOptions);
  EXPECT_FALSE(places.believe(kNow_s));
  EXPECT_FALSE(places.is_certain());
  places.add(place(0.0, 0.49));
  places.sift(kNow_s);
  EXPECT_TRUE(places.empty());
}

}  // namespace
}  // namespace mocha
