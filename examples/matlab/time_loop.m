% Example 8 in MATLAB and Octave: a block stands on the floor of a building, which your own code integrates.
% Compile stickslip_advance.c first; docs/guides/seismic_code.md says how.
dt = 0.005;                         % [s]
wn = 2 * pi / 0.5;                  % one storey, period 0.5 s, damping 5 %
displacement = 0; velocity = 0;     % of the floor, relative to the ground [m], [m/s]
slider.slip_level = 0.3 * 9.80665;  % [m/s^2]; fields that you leave out are 0
block = zeros(1, 6);                % x, x', mode, in_flight, gap, gap_velocity: at rest
floor_acceleration = 0;             % absolute [m/s^2]

for i = 1:2000
  t = i * dt;
  ground = 2 * exp(-t / 4) * sin(2 * pi * t / 0.5);  % [m/s^2]
  % One step of the building by the semi-implicit Euler method.
  pull = wn * wn * displacement + 2 * 0.05 * wn * velocity;
  velocity = velocity - (ground + pull) * dt;
  displacement = displacement + velocity * dt;
  segment = struct('duration', dt, 'start', floor_acceleration, 'end', -pull);
  block = stickslip_advance(slider, segment, block);
  floor_acceleration = -pull;
end

if block(3) == 0, how = 'at rest'; else, how = 'still sliding'; end
fprintf('after the earthquake the block is %.4f m from where it stood, %s\n', block(1), how);
