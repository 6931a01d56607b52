"""Large grains that begin below small ones rise to the top of a shaken bed, and stay below when it rests."""

from checking import STEPPERS, Check

with Check(__file__) as check:
    settings = {"simulation__end_time": 10.0} if check.full else {}
    for stepper in STEPPERS:
        seen = check.run(stepper, time_stepper__type=stepper, **settings).table("segregation.csv")
        small, large = seen["centre_small"], seen["centre_large"]
        check.holds(f"{stepper}: the large grains begin at the bottom", large[1] < 0.8 * small[1])
        # Halfway up is where they would be in a mixture.
        check.holds(f"{stepper}: they rise above the middle of the small ones", large[-1] > 1.2 * small[-1],
                    f"from {large[1] * 1e3:.1f} to {large[-1] * 1e3:.1f} mm, the small ones' middle is at {small[-1] * 1e3:.1f} mm")
    still = check.run("still", prescribed_motion__0__translation__by=0.0, simulation__end_time=1.0).table("segregation.csv")
    check.holds("without shaking they stay", still["centre_large"][-1] < 0.8 * still["centre_small"][-1])
