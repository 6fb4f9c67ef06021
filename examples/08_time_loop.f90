! Example 8 in Fortran: a block stands on the floor of a building, which your own code integrates.
program time_loop
  use, intrinsic :: iso_c_binding, only: c_double, c_ptr
  use stickslip ! stickslip/stickslip.f90, next to stickslip/stickslip.h
  implicit none
  real(c_double), parameter :: pi = acos(-1d0), dt = 0.005d0, wn = 2*pi/0.5d0
  type(stickslip_slider) :: slider
  type(c_ptr) :: model
  type(stickslip_state) :: block                                   ! at rest
  real(c_double) :: displacement = 0, velocity = 0, floor = 0 ! of the floor, relative to the ground; its acceleration
  real(c_double) :: t, ground, pull
  integer :: i

  slider%slip_level = 0.3d0*9.80665d0
  if (stickslip_create(slider, model) /= STICKSLIP_OK) error stop stickslip_message()
  do i = 1, 2000
    t = i*dt
    ground = 2*exp(-t/4)*sin(2*pi*t/0.5d0)                    ! [m/s^2]
    ! One storey, damping 5 %, period 0.5 s, integrated by the semi-implicit Euler method.
    pull = wn**2*displacement + 2*0.05d0*wn*velocity
    velocity = velocity - (ground + pull)*dt
    displacement = displacement + velocity*dt
    if (stickslip_step(model, stickslip_segment(dt, floor, -pull), block) /= STICKSLIP_OK) error stop stickslip_message()
    floor = -pull
  end do
  call stickslip_destroy(model)
  print '(a, f6.4, a)', 'after the earthquake the block is ', block%displacement, &
    ' m from where it stood, '//trim(merge('at rest      ', 'still sliding', abs(block%mode) < 0.5d0))
end program
