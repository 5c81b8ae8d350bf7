! rule: a module ends at ENDMODULE; what stands behind it is not read
! source: [K §9, 9.1] files hold modules; nothing derives what else is in a file
MODULE Demo
ENDMODULE
! a comment may stand here
MoveAbsJ home, v100, fine, tool0;  ! -> RG217?
ENDMODULE
