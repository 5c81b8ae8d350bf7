! rule: a file holds one module
! source: [manual] RobotWare 6 load
MODULE Demo
ENDMODULE
MODULE Other  ! -> RG217
ENDMODULE
