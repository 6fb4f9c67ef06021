# Example 8 in Julia: a block stands on the floor of a building, which your own code integrates.
#
#     julia time_loop.jl LIBRARY
#
# LIBRARY is the interface in C as a shared library; docs/guides/seismic_code.md says how to build it. The structs below
# have the fields of stickslip/stickslip.h, in its order.

const library = abspath(ARGS[1])

Base.@kwdef struct Slider
    slip_level::Cdouble = 0
    static_level::Cdouble = 0
    natural_frequency::Cdouble = 0
    damping::Cdouble = 0
    slope_degrees::Cdouble = 0
    gap::Cdouble = 0
    backward_gap::Cdouble = 0
    restitution::Cdouble = 0
    one_way::Cint = 0
    clipped::Cint = 0
end

struct Segment
    duration::Cdouble
    start::Cdouble
    end_::Cdouble
    vertical_start::Cdouble
    vertical_end::Cdouble
end

Base.@kwdef struct State
    displacement::Cdouble = 0
    velocity::Cdouble = 0
    mode::Cdouble = 0
    in_flight::Cdouble = 0
    gap::Cdouble = 0
    gap_velocity::Cdouble = 0
end

"Returns the state of a slider at the end of a segment."
function advance(slider::Slider, segment::Segment, state::State)
    after = Ref(state)
    status = ccall((:stickslip_advance, library), Cint, (Ref{Slider}, Ref{Segment}, Ref{State}), slider, segment, after)
    status == 0 || error(unsafe_string(ccall((:stickslip_message, library), Cstring, ())))
    return after[]
end

function main()
    dt = 0.005                        # [s]
    wn = 2pi / 0.5                    # one storey, period 0.5 s, damping 5 %
    displacement = velocity = 0.0     # of the floor, relative to the ground [m], [m/s]
    slider = Slider(slip_level = 0.3 * 9.80665)
    block = State()                   # at rest
    floor = 0.0                       # absolute acceleration [m/s^2]
    for i in 1:2000
        t = i * dt
        ground = 2exp(-t / 4) * sin(2pi * t / 0.5)  # [m/s^2]
        # One step of the building by the semi-implicit Euler method.
        pull = wn^2 * displacement + 2 * 0.05 * wn * velocity
        velocity -= (ground + pull) * dt
        displacement += velocity * dt
        block = advance(slider, Segment(dt, floor, -pull, 0, 0), block)
        floor = -pull
    end
    how = block.mode == 0 ? "at rest" : "still sliding"
    println("after the earthquake the block is ", round(block.displacement, digits = 4), " m from where it stood, ", how)
end

main()
