!=== header
%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
! rule: a header between two %%% lines
! source: [code] 56 public files
MODULE Demo
ENDMODULE
!=== second_module
! rule: of a file with two modules the first is read
! source: [K §9] modules are loaded one by one or as a group; nothing says how a file holds a group
MODULE Demo
ENDMODULE
MODULE Other  ! -> RG217?
ENDMODULE
!=== text_behind
! rule: a module ends at ENDMODULE; what stands behind it is not read
! source: [K §9, 9.1] files hold modules; nothing derives what else is in a file
MODULE Demo
ENDMODULE
! a comment may stand here
MoveAbsJ home, v100, fine, tool0;  ! -> RG217?
ENDMODULE
